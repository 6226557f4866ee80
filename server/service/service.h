#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "server/http/client_limits.h"
#include "server/http/http_server.h"
#include "server/log/log_line.h"
#include "server/recording/old_recordings.h"
#include "server/recording/recording.h"
#include "server/store/job_store.h"

namespace armloom {

struct ServiceOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;                      // zero: any free one
  double speed = 1.0;                             // cell seconds per wall second
  std::string policy;                             // empty: the cell's
  std::vector<std::string> allowed_origins;       // of other sites (HostRule)
  std::vector<std::string> allowed_hosts;         // names that commands may come to (HostRule)
  std::optional<std::filesystem::path> tokens;    // file of those that are asked for; none: all may
  std::optional<TlsFiles> tls;                    // none: without
  std::filesystem::path web;                      // the dashboard's files
  std::optional<std::filesystem::path> data;      // where a recording is written; one in
                                                  // it is kept (Recording::unused_folder)
  StoreOptions store = {};                        // of the jobs in `data`
  bool record_states = false;                     // states.csv as well
  std::size_t connections_max = 4096;             // one more is refused with 503
  std::size_t connections_per_client_max = 4096;  // of one address; one more is refused with 429
  ClientLimits::Options limits = {};
  std::chrono::milliseconds keep_alive{15'000};  // of /events, when there are none
  std::chrono::milliseconds send_time{30'000};   // for one event of /events, or message of /ws
  int send_buffer = 128 * 1024;                  // of the socket of a reader of those
  std::chrono::milliseconds read_time{10'000};   // for a request's header, and for its body
  // What the server has to say beside the answers: what goes wrong, alerts, requests, recordings
  // that are removed. From any thread; must not block. Null: nobody listens.
  Log log = {};
  LoggedRequests logged_requests = LoggedRequests::none;
  RecordingBounds kept_recordings = {};             // in `data`
  std::chrono::milliseconds jog_lease{500};        // ApiParts
  std::size_t memory_max = std::size_t{64} << 20U;  // as Site has it
};

// The server: executive in real time, HTTP, WebSocket, dashboard. One thread for all connections
// (the caller of run()), one for the executive, one for judgements.
class Service {
 public:
  // Listens and begins to run the executive. Problems: those of Executive::create, the port in use,
  // the data folder not writable.
  [[nodiscard]] static Result<std::unique_ptr<Service>> start(CellPtr cell, const CellFile& source,
                                                              ServiceOptions options);
  ~Service();

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::optional<std::filesystem::path> recorded_to() const;
  void run(bool until_signal);  // until stop(), or SIGINT, SIGTERM, SIGHUP
  void stop();                  // thread-safe

  // After run(): ends the executive and writes the rest of jobs and recording. What could not be
  // written, if anything.
  [[nodiscard]] std::optional<std::string> close();

 private:
  class Impl;
  explicit Service(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom

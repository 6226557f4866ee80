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
  std::uint16_t port = 8080;                    // zero: any free port
  double speed = 1.0;                           // cell seconds per wall second
  std::string policy;                           // if empty, the policy of the cell
  std::vector<std::string> allowed_origins;     // of other sites (HostRule)
  std::vector<std::string> allowed_hosts;       // allowed Host names, for every request (HostRule)
  std::optional<std::filesystem::path> tokens;  // token file; without it, all requests are allowed
  std::optional<TlsFiles> tls;                  // nullopt: plain HTTP
  std::filesystem::path web;                    // the dashboard's files
  // folder for jobs and recordings (Recording::unused_folder)
  std::optional<std::filesystem::path> data;
  StoreOptions store = {};                        // of the jobs in `data`
  bool record_states = false;                     // write states.csv, too
  std::size_t connections_max = 4096;             // beyond: 503
  std::size_t connections_per_client_max = 4096;  // of one address; beyond: 429
  ClientLimits::Options limits = {};
  std::chrono::milliseconds keep_alive{15'000};  // silence on /events before a keep-alive comment
  std::chrono::milliseconds send_time{30'000};   // for one event of /events, or message of /ws
  int send_buffer = 128 * 1024;                  // of a subscriber's socket
  std::chrono::milliseconds read_time{10'000};   // for a request's header, and for its body
  // Gets faults, alerts, requests and removed recordings, from any thread. Must not block. May be
  // null.
  Log log = {};
  LoggedRequests logged_requests = LoggedRequests::none;
  RecordingBounds kept_recordings = {};             // for those in `data`
  std::chrono::milliseconds jog_lease{500};         // see ApiParts
  std::size_t memory_max = std::size_t{64} << 20U;  // see Site
};

// The whole server: an executive in real time, HTTP, WebSocket and dashboard. All connections are
// served on the thread that calls run(). The executive and collision checks have their own threads.
class Service {
 public:
  // Listens and starts the executive. Problems: those of Executive::create; the port is in use; the
  // data folder is not writable.
  [[nodiscard]] static Result<std::unique_ptr<Service>> start(CellPtr cell, const CellFile& source,
                                                              ServiceOptions options);
  ~Service();

  [[nodiscard]] std::uint16_t port() const;
  [[nodiscard]] std::optional<std::filesystem::path> recorded_to() const;
  void run(bool until_signal);  // until stop(), or SIGINT, SIGTERM, SIGHUP
  void stop();                  // thread-safe

  // Call after run(). Ends the executive and completes jobs and recording on disk. Returns what
  // could not be written and why, or nullopt.
  [[nodiscard]] std::optional<std::string> close();

 private:
  class Impl;
  explicit Service(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom

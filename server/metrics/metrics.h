#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/executive/events.h"
#include "core/model/cell.h"

namespace armloom {

// Prometheus metrics of a server session (text format 0.0.4), called "armloom_...", shown by
// config/grafana/armloom.json. Names and labels are part of the interface.
class Metrics {
 public:
  // `speed`: cell seconds per wall second. Below 1, periods may be longer accordingly.
  Metrics(CellPtr cell, double speed);
  ~Metrics();

  // On the executive's strand, at every control tick and every monitor period.
  void ticked();
  void watched(const StateFrame& frame);
  void judged(std::uint64_t evaluations);  // for one question of a decision
  // Thread-safe.
  void set_speed(double speed);
  void stop_taken(std::chrono::nanoseconds after);  // from the request to the strand
  void stored(std::chrono::nanoseconds within);     // a transaction, until it was synced

  // On the server's thread.
  void happened(const Event& event);
  // Refused by a client limit: "requests", "jobs", "connections".
  void limited(const char* what);
  // `route`: the matching pattern, or "".
  void answered(const std::string& method, const std::string& route, int status,
                std::chrono::nanoseconds after);

  // Values counted elsewhere.
  struct Readings {
    std::size_t readers = 0;  // of events and poses
    std::uint64_t frames_dropped = 0;
    std::uint64_t subscribers_disconnected = 0;
    bool recording_lost = false;
    bool storage_failed = false;
  };
  [[nodiscard]] std::string text(const Readings& readings);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom

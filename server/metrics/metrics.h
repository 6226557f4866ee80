#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/executive/events.h"
#include "core/model/cell.h"

namespace armloom {

// Prometheus metrics of a server session (text format 0.0.4). Their names begin with "armloom_";
// config/grafana/armloom.json displays them. Names and labels are part of the interface.
class Metrics {
 public:
  // `speed`: cell seconds per wall second. If it is below 1, the loops may take longer periods in
  // proportion.
  Metrics(CellPtr cell, double speed);
  ~Metrics();

  // Call on the executive's strand: ticked() at every control tick, watched() at every monitor
  // period.
  void ticked();
  void watched(const StateFrame& frame);
  // Call on the strand when a monitor period begins, and when the monitor has stopped arms in it.
  void watch_begins();
  void monitor_stopped(std::size_t arms);
  void judged(std::uint64_t evaluations);  // collision evaluations for one question
  // Thread-safe.
  void set_speed(double speed);
  void stop_taken(std::chrono::nanoseconds after);  // time from the request to the strand
  void stored(std::chrono::nanoseconds within);     // duration of a transaction, with its sync

  // On the server's thread.
  void happened(const Event& event);
  // Counts a refusal by a client limit. `what`: "requests", "jobs" or "connections".
  void limited(const char* what);
  // Counts an answered request. `route`: the matching pattern, or "".
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

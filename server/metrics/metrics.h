#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/executive/events.h"
#include "core/model/cell.h"

namespace armloom {

// Figures of a run of the server for Prometheus (text format 0.0.4), all called "armloom_...".
// config/grafana/armloom.json shows them. Names and labels are part of the interface.
class Metrics {
 public:
  // `speed`: cell seconds per wall second; periods that are longer by that count as kept.
  Metrics(CellPtr cell, double speed);
  ~Metrics();

  // On the executive's strand, at every control tick and every monitor period.
  void ticked();
  void watched(const StateFrame& frame);
  void judged(std::uint64_t evaluations);  // a decision's question was answered
  // Thread-safe.
  void set_speed(double speed);
  void stop_taken(std::chrono::nanoseconds after);  // from the request to the strand
  void stored(std::chrono::nanoseconds within);     // a transaction, until it was synced

  // On the server's thread.
  void happened(const Event& event);
  // Over a limit of clients: "requests", "jobs", "connections".
  void limited(const char* what);
  // `route`: the pattern that fits, "" for none.
  void answered(const std::string& method, const std::string& route, int status,
                std::chrono::nanoseconds after);

  // What others count, at the moment of asking.
  struct Readings {
    std::size_t readers = 0;  // of events and poses
    std::uint64_t frames_dropped = 0;
    std::uint64_t readers_sent_away = 0;
    bool recording_lost = false;
    bool storage_failed = false;
  };
  [[nodiscard]] std::string text(const Readings& readings);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom

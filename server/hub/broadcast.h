#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "core/executive/executive.h"
#include "server/codec/wall_clock.h"
#include "server/durable/alert_book.h"
#include "server/durable/job_keeper.h"
#include "server/hub/hub.h"
#include "server/hub/recent_states.h"
#include "server/log/log_line.h"
#include "server/metrics/metrics.h"
#include "server/recording/recording.h"

namespace armloom {

// Carries the executive's events and states from its strand to the server's thread. On the strand,
// it only copies them. On the server's thread, it writes each event as JSON once, passes the event
// to the hub and records it.
class Broadcast final : public Observer {
 public:
  // shortest time between frames, in wall time
  inline static constexpr std::chrono::milliseconds kFramePeriod{33};
  // Limit for the pose frames to all subscribers together. With more subscribers, each gets fewer
  // frames, so that the server can still answer requests.
  inline static constexpr std::size_t kFramesPerSecond = 20'000;

  struct Parts {
    CellPtr cell;
    std::string stream;
    WallClock& clock;  // used on the server's thread
    Hub& hub;
    RecentStates& states;
    Recording* recording;  // may be null
    JobKeeper* keeper;     // null if jobs end with the server
    AlertBook& alerts;
    std::function<void(std::function<void()>)> post;         // to the server's thread, in order
    std::function<void(std::function<void()>)> post_urgent;  // ahead of `post`
    Log log;
    std::function<void(Alert)> tell;  // raises an alert on the executive
    Metrics& metrics;
  };
  explicit Broadcast(Parts parts) : parts_(std::move(parts)) {}

  void on_event(const Event& event) override;
  void on_tick(TimePoint now, const Configuration& measured) override;
  void on_truth(TimePoint now, const Configuration& positions) override {
    if (parts_.recording != nullptr) parts_.recording->truth(now, positions);
  }
  void on_rest(bool at_rest) override;
  void on_stops(const std::vector<ArmId>& stopped) override;
  void on_judged(std::uint64_t evaluations) override { parts_.metrics.judged(evaluations); }
  void on_watch() override { parts_.metrics.watch_begins(); }
  void on_monitor_stop(std::size_t arms) override { parts_.metrics.monitor_stopped(arms); }
  void on_state(const StateFrame& frame) override;

 private:
  void watch_recording();

  Parts parts_;
  bool said_lost_ = false;
  std::chrono::steady_clock::time_point next_frame_{};  // used on the strand
  std::atomic<std::size_t> readers_{0};
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "core/executive/executive.h"
#include "core/executive/executive_input.h"
#include "core/executive/hold_to_run.h"
#include "core/executive/run_count.h"

namespace armloom {

// Time, input log, figures and end of a session.
struct Session {
  TimePoint now{};
  std::optional<TimePoint> wake_at = {};  // requested by the scheduler
  HoldToRun held = {};                    // jobs that end with their lease
  bool quiet = false;     // in the last cycle all arms were settled and there was no report
  bool monitored = true;  // ExecutiveOptions
  std::optional<TimePoint> dies_at = {};  // likewise
  std::uint64_t ticks = 0;
  InputLog* inputs = nullptr;  // receives the inputs between the ticks
  TimePoint shows_check_at{};  // next publication of a check's progress
  RunCount count;
  // Set when the shutdown has begun.
  struct WindDown {
    std::function<void()> done;
    bool keeps_waiting;
  };
  std::optional<WindDown> wind_down = {};

  void note(const ExecutiveInput& input) const {
    if (inputs != nullptr) inputs->came(ticks, input);
  }
};

}  // namespace armloom

#pragma once

#include <algorithm>
#include <span>

#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// Period of the executive's control cycle, and of a simulated arm's.
inline constexpr Duration kControlPeriod = std::chrono::milliseconds(1);

// Authority is extended by at least this much, except up to a limit. Bounds the number of commands.
inline constexpr Duration kGrantStep = std::chrono::milliseconds(80);

// The times that the controllers of a motion's arms promise (ControllerDescription), and the bounds
// that follow from them. A bound is never below its minimum, which is policy. The default promises
// give exactly these minimums.
struct Promises {
  Duration reaction{};
  Duration feedback_period{};
  Duration feedback_timeout{};

  inline static constexpr Duration kFreeRunMin = std::chrono::milliseconds(250);
  inline static constexpr Duration kStandsFromMin = std::chrono::milliseconds(250);
  inline static constexpr Duration kPaceFromMin = std::chrono::milliseconds(100);
  inline static constexpr Duration kReportAgeMin = std::chrono::milliseconds(100);
  inline static constexpr Duration kOutOfStepMin = std::chrono::milliseconds(50);

  // Longest time from a state of the arm, by way of a report and a decision of the server, to the
  // effect of the command that answers it:
  //   feedback_period + kControlPeriod + reaction
  // The second form is for the last report before the arm counts as lost.
  [[nodiscard]] Duration response() const { return feedback_period + kControlPeriod + reaction; }
  [[nodiscard]] Duration late_response() const {
    return std::max(feedback_period, feedback_timeout) + kControlPeriod + reaction;
  }
  // How far authority reaches beyond the stopping distance, so that an arm does not brake while its
  // reports are merely late:
  //   max(kFreeRunMin, late_response() + kGrantStep)
  [[nodiscard]] Duration free_run() const {
    return std::max(kFreeRunMin, late_response() + kGrantStep);
  }
  // An arm is at rest if its progress has not changed for this long. A starting or braking arm may
  // be measured at one position for a shorter time: max(kStandsFromMin, late_response()).
  [[nodiscard]] Duration stands_from() const { return std::max(kStandsFromMin, late_response()); }
  // The speed of a motion is measured over at least this much of its path, so that a start that is
  // late as promised counts little: max(kPaceFromMin, 4 response()).
  [[nodiscard]] Duration pace_from() const { return std::max(kPaceFromMin, 4 * response()); }
  // How far the progress of an arm at rest may be ahead of the progress from which the server
  // starts it: max(kReportAgeMin, response()).
  [[nodiscard]] Duration report_age() const { return std::max(kReportAgeMin, response()); }
  // How late a motion may end beyond its scaled duration: max(given, late_response()).
  [[nodiscard]] Duration overrun_margin(Duration given) const {
    return std::max(given, late_response());
  }
  // An arm of a synchronous motion that leads by more than this is ordered to wait
  // (core/coordination/in_step.h). The authority of the leading arm is renewed in steps of half of
  // it, so the rest must cover a response: max(kOutOfStepMin, 2 response()).
  [[nodiscard]] Duration out_of_step() const { return std::max(kOutOfStepMin, 2 * response()); }
  // Age of the progress on which the order to wait rests: feedback_period + kControlPeriod.
  [[nodiscard]] Duration until_told() const { return feedback_period + kControlPeriod; }
};

[[nodiscard]] inline Promises promises_of(const ControllerDescription& controller) {
  return {controller.reaction, controller.feedback_period, controller.feedback_timeout};
}
// Returns the longest times of the arms' controllers.
[[nodiscard]] inline Promises promises_of(const Cell& cell, std::span<const ArmId> arms) {
  Promises longest;
  for (const ArmId arm : arms) {
    const Promises one = promises_of(cell.robots[cell.arm(arm).robot.index()].controller);
    longest.reaction = std::max(longest.reaction, one.reaction);
    longest.feedback_period = std::max(longest.feedback_period, one.feedback_period);
    longest.feedback_timeout = std::max(longest.feedback_timeout, one.feedback_timeout);
  }
  return longest;
}

}  // namespace armloom

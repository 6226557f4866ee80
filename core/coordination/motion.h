#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/tracking_errors.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A view of a step for a collision check. At the question's instant the motion is at `progress`
// (trajectory time, <= duration). From there it runs to its end and then rests at the goal. If
// `progress` is negative, the arm first rests at the motion's start for the duration -progress.
struct Motion {
  StepId step;
  TrajectoryPtr trajectory;
  Duration progress;
  bool to_come = false;  // Coordinated only: its arm executes another motion first
  // Largest distance of a joint from the path when the motion starts or resumes (rad, m). Certified
  // methods use, for each arm, the larger value of off_path and its tracking error.
  double off_path = 0.0;
  // Used only by TimedDiscrete, because there no passing orders protect a paused motion.
  enum class Stands : std::uint8_t {
    goes_on,
    may_stay,  // brakes, or has not moved for a while: checked as moving and as at rest
    stays,     // was stopped; will be checked again before it continues
  };
  Stands stands = Stands::goes_on;
  // Speed override, 0 to 1. Used only by TimedDiscrete, because only there times matter.
  double share = 1.0;

  [[nodiscard]] Duration remaining() const { return trajectory->duration() - progress; }
};

// The paper's method: compares the motions at equal instants, every `step`. Guarantees nothing
// between these instants.
struct TimedDiscrete {
  Duration step;
};
// Ignores times: checks the whole remainder of each motion against the whole remainder of every
// other motion.
struct Swept {
  TrackingErrors tracking_errors;
};
// Ignores times: finds the states of each pair that are not certified free (Verdict::regions). An
// arm may have several motions, in execution order, each starting at the end of the previous
// motion.
struct Coordinated {
  TrackingErrors tracking_errors;
};
using CheckMethod = std::variant<TimedDiscrete, Swept, Coordinated>;
// Returns the tracking errors; zero if the method has none.
[[nodiscard]] inline TrackingErrors tracking_errors_of(const CheckMethod& method) {
  if (const auto* swept = std::get_if<Swept>(&method)) return swept->tracking_errors;
  const auto* coordinated = std::get_if<Coordinated>(&method);
  return coordinated != nullptr ? coordinated->tracking_errors : 0.0;
}

// Asks if a motion is free, from its progress on, while another arm rests at `rest`.
struct PassageQuestion {
  Motion motion;
  ArmId arm;
  Eigen::VectorXd rest;  // positions of the arm's joints, in the arm's order
};

// Asks if the candidates may start together, given all other motions and resting arms. Plain
// data, safe to pass to another thread.
struct Question {
  Version version;                 // of the reservations from which `others` and `rest` were made
  TimePoint start_at;              // the instant at which each motion is at its `progress`
  std::vector<Motion> candidates;  // usually one; several are checked as one synchronous start
  std::vector<Motion> others;      // every motion that holds a reservation
  Configuration rest;              // positions of the joints that are in none of these motions
  CheckMethod method;
  std::vector<PassageQuestion> passages = {};  // answered whatever the result for the candidates
  // Multiple of the usual budget of evaluations (not for TimedDiscrete).
  std::uint64_t effort = 1;
  // Permits pairs that are too close at the question's instant to move apart. Must be false if the
  // arms are not yet at these positions.
  bool may_part = true;
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// One job's motion in a collision check. At the question's instant the motion is at `progress`
// (trajectory time, <= duration), from which it runs to the end and rests at the goal. If
// `progress` is negative, the motion first rests at its start for that long.
struct Motion {
  JobId job;
  TrajectoryPtr trajectory;
  Duration progress;
  bool to_come = false;  // Coordinated only: its arm executes another motion first
  // Largest distance of its joints from the path at its start or resume (rad, m). Certified methods
  // use the larger of this and their tracking error.
  double off_path = 0.0;
  // TimedDiscrete only: no passing orders protect a paused motion.
  enum class Stands : std::uint8_t {
    goes_on,
    may_stay,  // brakes, or has not moved for a while: both cases are checked
    stays,     // was stopped; checked again before it continues
  };
  Stands stands = Stands::goes_on;

  [[nodiscard]] Duration remaining() const { return trajectory->duration() - progress; }
};

// The paper's method: checks equal instants, every `step`. Guarantees nothing between them.
struct TimedDiscrete {
  Duration step;
};
// Ignores times: checks the whole remainder of each motion against that of every other motion.
struct Swept {
  double tracking_error;  // of each joint from its path (rad, m)
};
// Ignores times: finds the states of each pair that are not certified free (Verdict::regions). An
// arm may have several motions, in execution order, each starting at the end of the previous
// motion.
struct Coordinated {
  double tracking_error;
};
using CheckMethod = std::variant<TimedDiscrete, Swept, Coordinated>;
// Returns the tracking error of each joint (rad, m); zero if the method has none.
[[nodiscard]] inline double tracking_error_of(const CheckMethod& method) {
  if (const auto* swept = std::get_if<Swept>(&method)) return swept->tracking_error;
  const auto* coordinated = std::get_if<Coordinated>(&method);
  return coordinated != nullptr ? coordinated->tracking_error : 0.0;
}

// Asks if a motion is free, from its progress on, while another arm rests at `rest`.
struct PassageQuestion {
  Motion motion;
  ArmId arm;
  Eigen::VectorXd rest;  // the arm's joints, in its order
};

// Asks if the candidates may start together, given all other motions and resting arms. Plain
// data, safe to pass to another thread.
struct Question {
  Version version;                 // of the reservations behind `others` and `rest`
  TimePoint start_at;              // the question's instant
  std::vector<Motion> candidates;  // usually one; several are checked as one synchronous start
  std::vector<Motion> others;      // every motion that holds a reservation
  Configuration rest;              // joints that are in none of these motions
  CheckMethod method;
  std::vector<PassageQuestion> passages = {};  // answered whatever the result for the candidates
  // Multiple of the usual budget of evaluations (not for TimedDiscrete).
  std::uint64_t effort = 1;
  // Lets pairs that are too close at the question's instant move apart. Must be false if the arms
  // are not really there yet.
  bool may_part = true;
};

}  // namespace armloom

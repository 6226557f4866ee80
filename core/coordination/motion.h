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

// One job's motion as a judgement sees it. Zero is the instant that the question asks about:
// there the motion stands at `progress` of its trajectory (trajectory time, 0 <= progress <=
// duration), from there it advances second by second to the end and rests at the goal.
// A negative progress is a motion that is still to start: it rests at its start for that long.
struct Motion {
  JobId job;
  TrajectoryPtr trajectory;
  Duration progress;
  bool to_come = false;  // Coordinated: its arm makes another motion before it
  // Its joints are up to so far from the path where it sets out (rad, m): certified methods take
  // the larger of this and their tracking error.
  double off_path = 0.0;
  // TimedDiscrete, which has no orders that would keep others away from where it stands.
  enum class Stands : std::uint8_t {
    goes_on,
    may_stay,  // it brakes, or has not moved for a while: compared both ways
    stays,     // it was stopped, and is asked about before it goes on
  };
  Stands stands = Stands::goes_on;

  [[nodiscard]] Duration remaining() const { return trajectory->duration() - progress; }
};

// How motions are compared.
struct TimedDiscrete {  // the paper's: at equal instants, every `step`; between them nothing is
                        // promised
  Duration step;
};
struct Swept {            // whatever the times: all of what remains of one against all of the other
  double tracking_error;  // of each joint against its path (rad, m)
};
struct Coordinated {  // no times at all: in which states of each pair it is not certified that both
                      // may be (Verdict::regions). Of one arm, several motions may be named, in the
                      // order in which it will make them; each begins where the one before ends
  double tracking_error;
};
using CheckMethod = std::variant<TimedDiscrete, Swept, Coordinated>;
// Of each joint against its path (rad, m); zero where none is looked at.
[[nodiscard]] inline double tracking_error_of(const CheckMethod& method) {
  if (const auto* swept = std::get_if<Swept>(&method)) return swept->tracking_error;
  const auto* coordinated = std::get_if<Coordinated>(&method);
  return coordinated != nullptr ? coordinated->tracking_error : 0.0;
}

// Does this motion find its way free, from its progress on, while an arm that it does not move
// rests there?
struct PassageQuestion {
  Motion motion;
  ArmId arm;
  Eigen::VectorXd rest;  // of the arm's joints, in its order
};

// "May these candidates start together at the question's instant, beside everything else?"
// Plain data: complete, self-contained, safe to hand to another thread.
struct Question {
  Version version;                 // of the reservations that `others` and `rest` were read from
  TimePoint start_at;              // the question's instant, in cell time
  std::vector<Motion> candidates;  // usually one; several are judged as one synchronous start
  std::vector<Motion> others;      // every motion that holds a reservation
  Configuration rest;              // where every joint that is in none of these motions stands
  CheckMethod method;
  std::vector<PassageQuestion> passages = {};  // asked besides, whatever becomes of the candidates
  // How many times the usual budget of evaluations an answer may cost (not for TimedDiscrete).
  std::uint64_t effort = 1;
  // Pairs that are too close at the question's instant may part: not where nothing stands there
  // yet.
  bool may_part = true;
};

}  // namespace armloom

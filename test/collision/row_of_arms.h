#pragma once

#include "core/collision/check/timed_discrete_check.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"

namespace armloom::row_of_arms {

using namespace std::chrono_literals;
inline const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

// Returns three arms of one 0.4 m link each, in a row along x with bases 0.7 m apart. Links turn
// about z: 0 rad points to the right neighbor, pi to the left. Neighbors overlap only if they point
// at each other.
inline Cell row() {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ}, {0.4, 0.03});
  small::add_robot(cell, "b", small::at_xyz(0.7, 0, 0), {kZ}, {0.4, 0.03});
  small::add_robot(cell, "c", small::at_xyz(1.4, 0, 0), {kZ}, {0.4, 0.03});
  return cell;
}
inline const ArmId kA{0};
inline const ArmId kB{1};
inline const ArmId kC{2};
inline constexpr double kPi = small::kHalfTurn;
inline constexpr double kUp = kPi / 2;

struct Judged {
  explicit Judged(Cell made)
      : cell(small::shared(std::move(made))), checker(*PlanningScene::build(cell)) {
    question.version = 42;
    question.start_at = at(0s);
    question.rest = Configuration::Constant(static_cast<Eigen::Index>(cell->joints.size()), kUp);
    question.method = TimedDiscrete{50ms};
  }
  Motion motion(std::uint64_t job, ArmId arm, double from, double to, Duration duration) const {
    return {StepId{JobId{job}}, small::sweep(*cell, {arm}, {from}, {to}, duration), 0s};
  }
  static Motion begun(Motion motion, Duration progress) {
    motion.progress = progress;
    return motion;
  }
  Verdict operator()() { return timed_discrete_check(question, checker); }

  CellPtr cell;
  small::ScaledQuery checker;
  Question question;
};

}  // namespace armloom::row_of_arms

#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "test/experiments/lower_bound.h"

namespace armloom::experiments {

// One arm's motions, laid end to end, in squares of time.
struct Lane {
  struct Leg {
    TrajectoryPtr motion;  // the first of those that are alike
    std::size_t squares;
    TimePoint from;  // Work::from
  };
  ArmId arm;
  std::vector<Leg> legs;

  [[nodiscard]] std::size_t squares() const;
};

// The coordination diagram of all motions of one arm against all of another's, in squares of
// kSquare: the cells of the diagrams of pairs (MotionChecker::draw, no wider than that where they
// are decided; each pair of motions once) laid on them. Clearance is the cell's clearance_m, and
// arms are exactly on their paths. Not thread-safe.
class JoinedDiagram {
 public:
  inline static constexpr Duration kSquare = std::chrono::milliseconds(10);

  // Throws std::runtime_error when the scene cannot be built.
  explicit JoinedDiagram(const CellPtr& cell);

  // `work`: of the arm in its order, others' are passed over. Throws std::invalid_argument where a
  // duration is no multiple of kSquare.
  [[nodiscard]] static Lane lane_of(ArmId arm, const std::vector<Work>& work);

  // One square of `leg` of the rows' lane against all of the columns' lane.
  struct Row {
    std::vector<char> in_conflict;  // proven all over the square
    std::vector<char> not_free;     // not proven to be free somewhere in it
  };
  // `row` has its size afterwards.
  void read(const Lane::Leg& leg, std::size_t square, const Lane& columns, Row& row);

 private:
  [[nodiscard]] const Row& between(const Lane::Leg& a, const Lane::Leg& b);
  [[nodiscard]] Row drawn(const Lane::Leg& a, const Lane::Leg& b);

  Configuration rest_;
  MotionChecker checker_;
  std::map<std::pair<const Trajectory*, const Trajectory*>, Row> blocks_;  // row by row
};

}  // namespace armloom::experiments

#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "test/experiments/lower_bound.h"

namespace armloom::experiments {

// The motions of one arm, end to end, in squares of time.
struct Lane {
  struct Leg {
    TrajectoryPtr motion;  // the first of equal motions
    std::size_t squares;
    TimePoint from;  // Work::from
  };
  ArmId arm;
  std::vector<Leg> legs;

  [[nodiscard]] std::size_t squares() const;
};

// The coordination diagram of all motions of one arm against all motions of another, in squares of
// kSquare. Projects the cells of the pair diagrams onto squares (MotionChecker::draw; decided cells
// are no wider than a square; each pair of motions once). Uses the cell's clearance_m, with arms
// exactly on their paths. Not thread-safe.
class JoinedDiagram {
 public:
  inline static constexpr Duration kSquare = std::chrono::milliseconds(10);

  // Throws std::runtime_error if the scene cannot be built.
  explicit JoinedDiagram(const CellPtr& cell);

  // Selects from `work` the motions of the arm, in order. Throws std::invalid_argument if a
  // duration is not a multiple of kSquare.
  [[nodiscard]] static Lane lane_of(ArmId arm, const std::vector<Work>& work);

  // One square of `leg` in the rows' lane against the whole columns' lane.
  struct Row {
    std::vector<char> in_conflict;  // proven over the whole square
    std::vector<char> not_free;     // not proven free in a part of the square
  };
  // Resizes `row` as needed.
  void read(const Lane::Leg& leg, std::size_t square, const Lane& columns, Row& row);

 private:
  [[nodiscard]] const Row& between(const Lane::Leg& a, const Lane::Leg& b);
  [[nodiscard]] Row drawn(const Lane::Leg& a, const Lane::Leg& b);

  Configuration rest_;
  MotionChecker checker_;
  std::map<std::pair<const Trajectory*, const Trajectory*>, Row> blocks_;  // row by row
};

}  // namespace armloom::experiments

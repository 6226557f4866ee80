#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "test/experiments/lower_bound.h"

namespace armloom::experiments {

// The motions of one arm, one after the other, divided into squares of kSquare of time.
struct Lane {
  struct Leg {
    TrajectoryPtr motion;  // equal motions share one pointer
    std::size_t squares;
    TimePoint from;  // Work::from
  };
  ArmId arm;
  std::vector<Leg> legs;

  [[nodiscard]] std::size_t squares() const;
};

// The coordination diagram of all motions of two arms, in squares of kSquare. It is joined from the
// diagrams of pairs of motions (MotionChecker::draw), whose decided cells are no wider than a
// square. Uses the cell's clearance_m and exact paths. Not thread-safe.
class JoinedDiagram {
 public:
  inline static constexpr Duration kSquare = std::chrono::milliseconds(10);

  // Throws std::runtime_error if the scene cannot be built.
  explicit JoinedDiagram(const CellPtr& cell);

  // Selects the arm's motions, in order. Throws std::invalid_argument if a duration is not a
  // multiple of kSquare.
  [[nodiscard]] static Lane lane_of(ArmId arm, const std::vector<Work>& work);

  struct Row {
    std::vector<char> in_conflict;  // proven over the whole square
    std::vector<char> not_free;     // not proven free in a part of the square
  };
  void read(const Lane::Leg& leg, std::size_t square, const Lane& columns, Row& row);

 private:
  [[nodiscard]] const Row& between(const Lane::Leg& a, const Lane::Leg& b);
  [[nodiscard]] Row drawn(const Lane::Leg& a, const Lane::Leg& b);

  Configuration rest_;
  MotionChecker checker_;
  std::map<std::pair<const Trajectory*, const Trajectory*>, Row> blocks_;  // row by row
};

}  // namespace armloom::experiments

#pragma once

#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/tracking_errors.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A rectangle of the coordination diagram of two motions A and B: an interval of trajectory times
// of each.
struct DiagramCell {
  enum class State : std::uint8_t {
    free,       // the arms keep their clearance in every state (certified)
    conflict,   // the arms violate their clearance in every state
    undecided,  // some states are free and some are not, or nothing is proven
  };
  Duration from_a, to_a, from_b, to_b;
  State state;
};
[[nodiscard]] constexpr const char* to_string(DiagramCell::State state) {
  switch (state) {
    case DiagramCell::State::free:
      return "free";
    case DiagramCell::State::conflict:
      return "conflict";
    case DiagramCell::State::undecided:
      return "undecided";
  }
  return nullptr;
}

// The coordination diagram of one arm of A and one arm of B.
struct DiagramLayer {
  ArmId arm_a;
  ArmId arm_b;
  std::vector<DiagramCell> cells;  // together they cover both motions completely
};

// Requests the coordination diagram of two motions.
struct Drawing {
  TrajectoryPtr a;
  TrajectoryPtr b;
  Configuration rest;  // positions of the joints that are in neither motion
  TrackingErrors tracking_errors;
  Duration resolution;
  std::uint64_t budget;  // cells per pair of arms
};

// The coordination diagram of two motions, with a layer for each pair of an arm of A and an arm of
// B.
struct Diagram {
  Duration duration_a;
  Duration duration_b;
  std::vector<DiagramLayer> layers;
  std::uint64_t evaluations = 0;
};

}  // namespace armloom

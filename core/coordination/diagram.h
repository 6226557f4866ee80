#pragma once

#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// A rectangle of trajectory times of A and of B.
struct DiagramCell {
  enum class State : std::uint8_t {
    free,       // the arms keep their clearance in every state (certified)
    conflict,   // they violate it in every state
    undecided,  // both kinds, or not proven
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

// Diagram of two arms' motions.
struct DiagramLayer {
  ArmId arm_a;
  ArmId arm_b;
  std::vector<DiagramCell> cells;  // cover the rectangle of both motions
};

// Requests the coordination diagram of two motions.
struct Drawing {
  TrajectoryPtr a;
  TrajectoryPtr b;
  Configuration rest;  // positions of the joints that are in neither motion
  double tracking_error;
  Duration resolution;
  std::uint64_t budget;  // cells per pair of arms
};

// One layer for each arm of A and each arm of B.
struct Diagram {
  Duration duration_a;
  Duration duration_b;
  std::vector<DiagramLayer> layers;
  std::uint64_t evaluations = 0;
};

}  // namespace armloom

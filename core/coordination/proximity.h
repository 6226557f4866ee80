#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/base/ids.h"

namespace armloom {

// Two bodies that come too close, and how close. Names are links (with prefix) or objects. What an
// arm holds belongs to the arm.
struct Proximity {
  std::string body_a;          // a link, or held
  std::string body_b;          // a link, held, or an object of the scene
  std::optional<ArmId> arm_a;  // empty: a static link
  std::optional<ArmId> arm_b;  // empty: a static link or an object
  bool object_b = false;       // body_b is an object of the scene
  double clearance_m = 0.0;    // distance; zero or less in contact
  bool held_a = false;         // body_a is an object that arm_a holds
  bool held_b = false;         // body_b is an object that arm_b holds
  double limit_m = 0.0;        // what they should have kept, where they were asked for that

  bool operator==(const Proximity&) const = default;
};

// The same evidence as the second body sees it.
[[nodiscard]] inline Proximity turned_around(Proximity proximity) {
  std::swap(proximity.body_a, proximity.body_b);
  std::swap(proximity.arm_a, proximity.arm_b);
  std::swap(proximity.held_a, proximity.held_b);
  return proximity;
}

}  // namespace armloom

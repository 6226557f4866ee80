#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "core/base/ids.h"

namespace armloom {

// Two bodies that come too close, and their distance. The bodies are named by link (with prefix) or
// object. An attached object belongs to its arm.
struct Proximity {
  std::string body_a;          // a link or attached object
  std::string body_b;          // a link, attached object, or object of the scene
  std::optional<ArmId> arm_a;  // nullopt if body_a is a static link
  std::optional<ArmId> arm_b;  // nullopt if body_b is a static link or an object
  bool object_b = false;       // body_b is an object of the scene
  double clearance_m = 0.0;    // distance; zero or less in contact
  bool held_a = false;         // body_a is attached to arm_a
  bool held_b = false;         // body_b is attached to arm_b
  double limit_m = 0.0;        // required clearance; zero if not given

  bool operator==(const Proximity&) const = default;
};

// Returns a length in words: "3.0 mm".
[[nodiscard]] inline std::string in_mm(double length_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f mm", 1e3 * std::abs(length_m));
  return text;
}

// Returns the evidence with the bodies swapped.
[[nodiscard]] inline Proximity turned_around(Proximity proximity) {
  std::swap(proximity.body_a, proximity.body_b);
  std::swap(proximity.arm_a, proximity.arm_b);
  std::swap(proximity.held_a, proximity.held_b);
  return proximity;
}

}  // namespace armloom

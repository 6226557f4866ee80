#pragma once

#include <string>

#include "core/base/problem.h"
#include "server/codec/pose_words.h"

namespace armloom {

// A robot as given with `armloom import --robot`.
struct Placement {
  std::string name;
  PoseWords base;
};

// Reads "right:x=0.75,yaw_deg=180" or a name alone. Keys are x, y, z in meters, and roll_deg,
// pitch_deg, yaw_deg in degrees about fixed axes. Each is zero by default. The problem is at
// "--robot" and names all faults.
[[nodiscard]] Result<Placement> read_placement(const std::string& text);

}  // namespace armloom

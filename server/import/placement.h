#pragma once

#include <string>

#include "core/base/problem.h"
#include "server/codec/pose_words.h"

namespace armloom {

// A robot of the cell to come, as `armloom import --robot` gives it.
struct Placement {
  std::string name;
  PoseWords base;
};

// "right:x=0.75,yaw_deg=180" or only a name: x, y, z in metres, roll_deg, pitch_deg, yaw_deg in
// degrees about fixed axes; what is left out is zero. Problem: at "--robot", with all that is
// wrong.
[[nodiscard]] Result<Placement> read_placement(const std::string& text);

}  // namespace armloom

#pragma once

#include <map>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Fixes the joints that the cell file's "fixed" names at the given values (rad or m). Also fixes
// mimic joints that follow them, and mimic joints with multiplier 0. Reports names that are not
// movable joints or are mimic joints, and values that are not finite or beyond the URDF's limits.
// Changes the URDF's text accordingly, because clients draw the robot from it. `pointer` is the
// robot's JSON pointer in the cell file.
void hold_joints(const std::map<std::string, double>& fixed, const std::string& pointer,
                 const std::string& robot, RobotTree& tree, Diagnostics& diagnostics);

}  // namespace armloom

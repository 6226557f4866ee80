#pragma once

#include <map>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Fixes joints at a value (rad or m), given by name in the cell file's "fixed". Also fixes the
// mimic joints that follow them, and mimic joints with multiplier 0. Names must be movable joints
// that are not mimics; values must be finite and within the URDF's limits. The URDF's text is
// changed accordingly, for clients that draw the robot from it. `pointer` points to the robot in
// the cell file.
void hold_joints(const std::map<std::string, double>& fixed, const std::string& pointer,
                 const std::string& robot, RobotTree& tree, Diagnostics& diagnostics);

}  // namespace armloom

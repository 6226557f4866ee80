#pragma once

#include <map>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Holds joints at a value (rad or m), as a cell file's "fixed" has them by name: they are fixed
// joints from then on, and so are the mimic joints that follow them, and those that follow a joint
// with multiplier 0. Names must be movable joints
// that follow no other; values finite and within the URDF's limits. The URDF's text is changed
// alike, so that whoever draws the robot from it sees it so. `pointer` is of the robot in the cell
// file.
void hold_joints(const std::map<std::string, double>& fixed, const std::string& pointer,
                 const std::string& robot, RobotTree& tree, Diagnostics& diagnostics);

}  // namespace armloom

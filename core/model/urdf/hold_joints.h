#pragma once

#include <map>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Fixes joints at a value (rad or m), by name as in the cell file's "fixed", and mimic joints that
// follow them or have multiplier 0. Names must be movable joints that are not mimics; values must
// be finite and within the URDF's limits. Also changes the URDF's text, from which clients draw the
// robot. `pointer` points to the robot in the cell file.
void hold_joints(const std::map<std::string, double>& fixed, const std::string& pointer,
                 const std::string& robot, RobotTree& tree, Diagnostics& diagnostics);

}  // namespace armloom

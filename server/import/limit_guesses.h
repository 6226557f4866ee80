#pragma once

#include <map>
#include <string>

#include "core/model/joint_limits_file.h"
#include "core/model/robot_tree.h"
#include "core/model/srdf_reader.h"

namespace armloom {

// Limits that a cell needs of the group's joints and that neither the URDF nor joint_limits.yaml
// (null: there is none) gives, by joint: cautious guesses, for somebody to replace.
[[nodiscard]] std::map<std::string, JointLimitsDescription> guess_limits(
    const RobotTree& tree, const RobotSemantics::JointSet& group, const LimitsFile* file);

}  // namespace armloom

#pragma once

#include <map>
#include <string>

#include "core/model/srdf/joint_limits_file.h"
#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Limits that a cell needs of an arm's joints and that neither the URDF nor joint_limits.yaml
// (null: there is none) gives, by joint: cautious guesses, for somebody to replace.
[[nodiscard]] std::map<std::string, JointLimitsDescription> guess_limits(
    const RobotTree& tree, const RobotSemantics::JointSet& joints, const LimitsFile* file);

}  // namespace armloom

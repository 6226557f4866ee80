#pragma once

#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// How the joints of groups lie to each other in the tree. No joints: every answer is that of "all".
using JointSet = RobotSemantics::JointSet;

[[nodiscard]] bool share_a_joint(const JointSet& a, const JointSet& b);
[[nodiscard]] bool holds(const JointSet& whole, const JointSet& part);

// Whether every joint of `below` moves with a joint of `above`.
[[nodiscard]] bool is_above(const RobotTree& tree, const JointSet& above, const JointSet& below);

// Whether every joint moves all of those after it: no two stand side by side.
[[nodiscard]] bool is_chain(const RobotTree& tree, const JointSet& joints);

[[nodiscard]] bool stand_side_by_side(const RobotTree& tree, const JointSet& a, const JointSet& b);

// Chains that both begin at the base of a torso: it can be held, and each has an arm of its own.
[[nodiscard]] bool share_a_torso(const RobotTree& tree, const JointSet& a, const JointSet& b);

}  // namespace armloom

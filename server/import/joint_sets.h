#pragma once

#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Relations between the joints of groups in the tree. A condition on every joint is true for an
// empty set.
using JointSet = RobotSemantics::JointSet;

[[nodiscard]] bool share_a_joint(const JointSet& a, const JointSet& b);
[[nodiscard]] bool holds(const JointSet& whole, const JointSet& part);

// Returns true if every joint of `below` moves with a joint of `above`.
[[nodiscard]] bool is_above(const RobotTree& tree, const JointSet& above, const JointSet& below);

// Returns true if every joint moves all later joints, so that no two are side by side.
[[nodiscard]] bool is_chain(const RobotTree& tree, const JointSet& joints);

[[nodiscard]] bool stand_side_by_side(const RobotTree& tree, const JointSet& a, const JointSet& b);

// Returns true if the two sets share only a torso at their base. The torso must not have more
// joints than the rest of either set.
[[nodiscard]] bool share_a_torso(const RobotTree& tree, const JointSet& a, const JointSet& b);

}  // namespace armloom

#pragma once

#include <vector>

#include "server/import/arm_groups.h"

namespace armloom {

// Returns true if the group `whole` consists of smaller groups in a chain that are an arm only
// together. None of them may be a gripper at the end. None may be a torso, unless the SRDF names it
// as a part. `choices`: decisions so far; groups smaller than `whole` are decided.
[[nodiscard]] bool is_one_arm(const GroupChoice& whole, const RobotTree& tree,
                              const RobotSemantics& semantics, const GroupNames& names,
                              const std::vector<GroupChoice>& choices);

}  // namespace armloom

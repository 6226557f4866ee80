#pragma once

#include <vector>

#include "server/import/arm_groups.h"

namespace armloom {

// Whether a group consists of others one after the other, and they are an arm only together: none
// of them is a gripper at the end, nor a torso unless the SRDF itself names it as a part.
// `choices`: what is known so far of all groups; smaller groups than `whole` are decided.
[[nodiscard]] bool is_one_arm(const GroupChoice& whole, const RobotTree& tree,
                              const RobotSemantics& semantics, const GroupNames& names,
                              const std::vector<GroupChoice>& choices);

}  // namespace armloom

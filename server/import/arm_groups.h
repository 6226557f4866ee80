#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// SRDF group data besides joints.
struct GroupNames {
  std::vector<std::string> in_order;                      // in file order
  std::map<std::string, std::vector<std::string>> parts;  // named subgroups of a group
  std::set<std::string> end_effectors;                    // groups of <end_effector>
};
// Precondition: read_srdf has read the text.
[[nodiscard]] GroupNames read_group_names(const std::string& srdf_text);

struct GroupChoice {
  std::string group;
  bool is_arm = false;
  std::string why;  // reason if not an arm: "it is made of left_arm, right_arm"
};
// Selects the groups that become arms, in file order. A group is an arm if it
// - is not an end effector,
// - is not made of arms (by name, or by joints side by side), or of an arm and a gripper,
// - shares joints with another arm only in a torso at its base,
// - is neither above nor below a larger arm, nor above two (a torso, a gripper), and
// - has at least three joints, if any group has.
// A chain of groups, none of which is an arm by itself (upper arm, forearm), forms one arm. Of two
// groups with equal joints the first is taken; of two nested groups the smaller, unless it has less
// than half the joints (a wrist).
[[nodiscard]] std::vector<GroupChoice> choose_arm_groups(const RobotTree& tree,
                                                         const RobotSemantics& semantics,
                                                         const GroupNames& names);

// Returns movable joints above an arm that are in no arm or in several (a torso), by index in the
// tree.
[[nodiscard]] std::set<std::size_t> joints_above_arms(const RobotTree& tree,
                                                      const RobotSemantics& semantics,
                                                      const std::vector<GroupChoice>& choices);

}  // namespace armloom

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
// Selects the groups that become arms, in file order. A group is an arm if all of these are true:
// - It is not an end effector.
// - Some of its joints move others (wheels do not), if there is such a group.
// - It does not consist of arms (subgroups by name, or groups whose joints are side by side), nor
//   of an arm and a gripper.
// - If it shares joints with another arm, these joints are a torso at the base of both.
// - It does not move a larger arm or two arms (a torso). It is not moved by a larger arm (a
// gripper).
// - It has at least three joints, if any group has.
// Groups in a chain that are an arm only together (upper arm, forearm) form one arm. Of two groups
// with the same joints, the first is taken. If one group contains the other, the smaller group is
// taken, unless it has less than half of the joints (a wrist).
[[nodiscard]] std::vector<GroupChoice> choose_arm_groups(const RobotTree& tree,
                                                         const RobotSemantics& semantics,
                                                         const GroupNames& names);

// Returns the movable joints that move an arm, but belong to no arm or to several arms (a torso).
// The result contains their indices in the tree.
[[nodiscard]] std::set<std::size_t> joints_above_arms(const RobotTree& tree,
                                                      const RobotSemantics& semantics,
                                                      const std::vector<GroupChoice>& choices);

}  // namespace armloom

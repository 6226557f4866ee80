#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// What the text of an SRDF says of its groups besides their joints.
struct GroupNames {
  std::vector<std::string> in_order;                      // of the file
  std::map<std::string, std::vector<std::string>> parts;  // groups that a group is made of
  std::set<std::string> end_effectors;                    // groups that an <end_effector> names
};
// Precondition: read_srdf has read the text.
[[nodiscard]] GroupNames read_group_names(const std::string& srdf_text);

struct GroupChoice {
  std::string group;
  bool is_arm = false;
  std::string why;  // half a sentence, why it is none: "made of left_arm, right_arm"
};
// Which groups are the robot's arms, in the order of the file. An arm is a group of joints of its
// own: no end effector, not made of arms (by name, or two that stand side by side by their joints)
// nor of an arm and a gripper, sharing no joint with another arm but those of a torso at its base,
// not above or below a larger one nor above two (a torso, a gripper), and of three joints at least
// where there is such a one. A chain of groups that each are no arm for itself is one arm, as an
// upper arm and a forearm. Of two that hold the same joints the first; of two where one holds the
// other the smaller, unless that is less than half of it (a wrist).
[[nodiscard]] std::vector<GroupChoice> choose_arm_groups(const RobotTree& tree,
                                                         const RobotSemantics& semantics,
                                                         const GroupNames& names);

// Movable joints above an arm that are in none or in several, as a torso: by index in the tree.
[[nodiscard]] std::set<std::size_t> joints_above_arms(const RobotTree& tree,
                                                      const RobotSemantics& semantics,
                                                      const std::vector<GroupChoice>& choices);

}  // namespace armloom

#include <algorithm>

#include "core/model/cell/robot_build.h"

namespace armloom {
namespace {

// Lists the names of the groups that an arm can have: groups with at least one movable joint.
std::string usable_groups(const RobotBuild& robot) {
  std::string text;
  for (const auto& [name, joints] : robot.semantics->groups) {
    const bool movable = std::any_of(joints.begin(), joints.end(),
                                     [&](std::size_t i) { return robot.joints[i].has_value(); });
    if ((movable || robot.tree.nameless) && text.size() < 200)
      text += (text.empty() ? "" : ", ") + name;
  }
  return text.empty() ? "no group has movable joints" : "groups with movable joints: " + text;
}

// Returns the joints of the arm's group, including fixed joints. If the group is unusable, reports
// it and returns nullopt. Without an SRDF, all joints form one arm, whose group has no name.
std::optional<RobotSemantics::JointSet> group_joints(const RobotBuild& robot,
                                                     const ArmDescription& arm,
                                                     const std::string& pointer,
                                                     Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& why) {
    diagnostics.in_cell("unknown-group", pointer + "/group", "arm " + arm.name + ": " + why,
                        arm.group);
    return std::nullopt;
  };
  RobotSemantics::JointSet joints;
  if (!robot.semantics) {
    if (!arm.group.empty())
      return refuse("group " + arm.group + " needs an SRDF, and the robot has none");
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      if (robot.joints[i]) joints.insert(i);
    }
  } else {
    const auto group = robot.semantics->groups.find(arm.group);
    if (group == robot.semantics->groups.end()) {
      return refuse("group '" + arm.group + "' is not in " + robot.semantics->file + "; " +
                    usable_groups(robot));
    }
    joints = group->second;
  }
  const bool movable = std::any_of(joints.begin(), joints.end(),
                                   [&](std::size_t i) { return robot.joints[i].has_value(); });
  if (movable) return joints;
  if (robot.tree.patched) return std::nullopt;  // joints may be misplaced
  if (!joints.empty())
    return refuse("all joints of group '" + arm.group +
                  "' are held by \"fixed\"; an arm needs a joint that can move");
  return refuse("group '" + arm.group + "' has no movable joint" +
                (robot.semantics ? "; " + usable_groups(robot) : ""));
}

}  // namespace

void add_arms(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics) {
  for (std::size_t a = 0; a < robot.description->arms.size(); ++a) {
    const ArmDescription& description = robot.description->arms[a];
    const std::string pointer = robot.pointer + "/arms/" + std::to_string(a);
    const auto group = group_joints(robot, description, pointer, diagnostics);
    if (!group) continue;
    const ArmId id(static_cast<std::uint32_t>(cell.arms.size()));
    Arm arm{.name = description.name,
            .robot = robot.id,
            .group = description.group,
            .joints = {},
            .gripper_joints = {},
            .links = {},
            .home = {},
            .named_states = {},
            .gripper_states = {},
            .payload = description.payload};
    for (const std::size_t index : *group) {
      if (!robot.joints[index]) continue;  // fixed
      const JointId joint_id = *robot.joints[index];
      arm.joints.push_back(joint_id);
      Joint& joint = cell.joints[joint_id.index()];
      if (!joint.arm) joint.arm = id;  // else refuse_shared_joints reports the joint
    }
    cell.robots[robot.id.index()].arms.push_back(id);
    cell.arms.push_back(std::move(arm));
    robot.arms.push_back({id, pointer, &description, {group->begin(), group->end()}});
  }
}

void assign_to_arms(const RobotBuild& robot, Cell& cell) {
  // A gripper's mimic joint may move links anywhere in the tree, so repeat until nothing changes.
  for (bool settled = false; !settled;) {
    settled = true;
    for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
      Link& link = cell.links[robot.links[i].index()];
      const auto above = link.parent ? cell.link(*link.parent).arm : std::nullopt;
      if (robot.joints[i] && above && !cell.joint(*robot.joints[i]).arm) {
        cell.joints[robot.joints[i]->index()].arm = above;
        cell.arms[above->index()].gripper_joints.push_back(*robot.joints[i]);
      }
      const auto own = link.driver ? cell.joint(*link.driver).arm : std::nullopt;
      const auto arm = own ? own : above;
      settled = settled && arm == link.arm;
      link.arm = arm;
    }
  }
  for (const LinkId id : robot.links) {
    if (const auto arm = cell.link(id).arm) cell.arms[arm->index()].links.push_back(id);
  }
  const auto& arms = cell.robots[robot.id.index()].arms;
  for (const ArmId id : arms) {
    auto& grippers = cell.arms[id.index()].gripper_joints;
    std::sort(grippers.begin(), grippers.end());
  }
}

}  // namespace armloom

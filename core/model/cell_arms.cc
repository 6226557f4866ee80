#include <algorithm>
#include <cmath>

#include "core/model/robot_build.h"

namespace armloom {
namespace {

std::string span_text(const Joint& joint) {
  const char* unit = joint.kind == JointKind::prismatic ? " m" : " rad";
  return "[" + text_of(joint.lower) + ", " + text_of(joint.upper) + "]" + unit;
}

// Without an SRDF the robot is one arm of all its joints, and its group has no name.
std::optional<RobotSemantics::JointSet> group_joints(const RobotBuild& robot,
                                                     const ArmDescription& arm,
                                                     const std::string& pointer,
                                                     Findings& findings) {
  const auto refuse = [&](const std::string& why) {
    findings.in_cell("unknown-group", pointer + "/group", "arm " + arm.name + ": " + why,
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
      return refuse("group '" + arm.group + "' is not in " + robot.semantics->file);
    }
    joints = group->second;
  }
  if (joints.empty()) return refuse("group '" + arm.group + "' holds no movable joint");
  return joints;
}

Eigen::VectorXd read_home(const ArmDescription& description, const std::vector<JointId>& joints,
                          const std::string& pointer, const Cell& cell, Findings& findings) {
  Eigen::VectorXd home(static_cast<Eigen::Index>(joints.size()));
  const bool given = description.home.size() == joints.size();
  if (!given && !description.home.empty()) {
    findings.in_cell("wrong-size", pointer + "/home",
                     "arm " + description.name + ": home has " +
                         std::to_string(description.home.size()) + " values, the group has " +
                         std::to_string(joints.size()) + " joints",
                     static_cast<double>(description.home.size()));
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = cell.joint(joints[j]);
    const double value = given ? description.home[j] : std::clamp(0.0, joint.lower, joint.upper);
    home[static_cast<Eigen::Index>(j)] = value;
    if (std::isfinite(value) && value >= joint.lower && value <= joint.upper) continue;
    findings.in_cell("limit-exceeded", pointer + "/home/" + std::to_string(j),
                     "arm " + description.name + ": home of " + joint.name + " is " +
                         text_of(value) + ", outside " + span_text(joint),
                     value);
  }
  return home;
}

void read_limit(const std::optional<double>& value, const char* key, const std::string& pointer,
                const std::string& joint, double& limit, Findings& findings) {
  if (!value) return;
  limit = *value;
  if (std::isfinite(*value) && *value > 0.0) return;
  findings.in_cell(
      "not-positive", pointer + "/" + key,
      "joint " + joint + ": " + key + " is " + text_of(*value) + ", it must be greater than 0",
      *value);
}

// Precondition: joint.arm is settled. Limits may name joints of the arm and of its gripper.
void read_limits(const RobotBuild& robot, const ArmDescription& arm, ArmId id,
                 const std::string& arm_pointer, Cell& cell, Findings& findings) {
  for (const auto& [name, given] : arm.limits) {
    const std::string pointer = arm_pointer + "/limits/" + pointer_token(name);
    const auto link = robot.tree.by_joint.find(name);
    const auto joint_id =
        link == robot.tree.by_joint.end() ? std::nullopt : robot.joints[link->second];
    if (!joint_id || cell.joint(*joint_id).arm != id) {
      findings.in_cell("unknown-joint", pointer,
                       "arm " + arm.name + " has no joint " + name + " to limit", name);
      continue;
    }
    Joint& joint = cell.joints[joint_id->index()];
    read_limit(given.acceleration, "acceleration_rad_s2", pointer, name, joint.acceleration_max,
               findings);
    read_limit(given.jerk, "jerk_rad_s3", pointer, name, joint.jerk_max, findings);
    joint.brake = 2.0 * joint.acceleration_max;
    read_limit(given.brake, "brake_rad_s2", pointer, name, joint.brake, findings);
  }
}

void read_named_states(const RobotBuild& robot, Arm& arm, const RobotSemantics::JointSet& group,
                       Findings& findings) {
  if (!robot.semantics) return;
  const auto states = robot.semantics->states.find(arm.group);
  if (states == robot.semantics->states.end()) return;
  for (const auto& [name, state] : states->second) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(group.size()));
    Eigen::Index row = 0;
    for (const std::size_t joint : group) {
      const auto value = state.find(joint);
      values[row++] = value == state.end() ? 0.0 : value->second;
      if (value != state.end()) continue;
      const std::string place =
          robot.semantics->file + ": group_state " + name + " of " + arm.group;
      findings.add({ProblemKind::invalid,
                    "missing",
                    place,
                    place + ": joint " + robot.tree.links[joint].joint + " has no value",
                    {}});
    }
    arm.named_states.emplace(name, std::move(values));
  }
}

// Arms upstream of each link, and the joints of no arm upstream of each link, by tree index.
struct Upstream {
  std::vector<std::set<ArmId>> arms;
  std::vector<std::set<JointId>> loose_joints;
};

Upstream upstream_of(const RobotBuild& robot, const Cell& cell) {
  Upstream up;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    const auto parent = robot.tree.links[i].parent;
    auto arms = parent ? up.arms[*parent] : std::set<ArmId>{};
    auto loose = parent ? up.loose_joints[*parent] : std::set<JointId>{};
    if (const auto driver = cell.link(robot.links[i]).driver) {
      if (const auto arm = cell.joint(*driver).arm)
        arms.insert(*arm);
      else
        loose.insert(*driver);
    }
    up.arms.push_back(std::move(arms));
    up.loose_joints.push_back(std::move(loose));
  }
  return up;
}

void refuse_shared_joints(const RobotBuild& robot, const Cell& cell, Findings& findings) {
  const Upstream up = upstream_of(robot, cell);
  const auto refuse = [&](const std::string& sentence) {
    findings.in_cell("shared-joint", robot.pointer + "/arms",
                     "robot " + robot.description->name + ": " + sentence);
  };
  std::set<std::set<ArmId>> told;
  std::map<JointId, std::set<ArmId>> arms_below;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    for (const JointId joint : up.loose_joints[i])
      arms_below[joint].insert(up.arms[i].begin(), up.arms[i].end());
    if (up.arms[i].size() < 2 || !told.insert(up.arms[i]).second) continue;
    refuse("arms " + cell.arm(*up.arms[i].begin()).name + " and " +
           cell.arm(*up.arms[i].rbegin()).name + " both move link " +
           cell.link(robot.links[i]).name + "; such arms are one arm");
  }
  for (const auto& [joint, arms] : arms_below) {
    if (arms.size() < 2) continue;
    refuse("arms " + cell.arm(*arms.begin()).name + " and " + cell.arm(*arms.rbegin()).name +
           " share the movable joint " + cell.joint(joint).name +
           " above them; such arms are one arm");
  }
}

}  // namespace

void add_arms(const RobotBuild& robot, Cell& cell, Findings& findings) {
  for (std::size_t a = 0; a < robot.description->arms.size(); ++a) {
    const ArmDescription& description = robot.description->arms[a];
    const std::string pointer = robot.pointer + "/arms/" + std::to_string(a);
    const auto group = group_joints(robot, description, pointer, findings);
    if (!group) continue;
    const ArmId id(static_cast<std::uint32_t>(cell.arms.size()));
    Arm arm{.name = description.name,
            .robot = robot.id,
            .group = description.group,
            .joints = {},
            .gripper_joints = {},
            .links = {},
            .home = {},
            .named_states = {}};
    for (const std::size_t index : *group) {
      const JointId joint_id = *robot.joints[index];
      Joint& joint = cell.joints[joint_id.index()];
      arm.joints.push_back(joint_id);
      if (joint.arm) {
        findings.in_cell("shared-joint", pointer + "/group",
                         "arm " + arm.name + ": joint " + joint.name + " belongs to arm " +
                             cell.arm(*joint.arm).name,
                         joint.name);
      } else {
        joint.arm = id;
      }
    }
    arm.home = read_home(description, arm.joints, pointer, cell, findings);
    read_named_states(robot, arm, *group, findings);
    cell.robots[robot.id.index()].arms.push_back(id);
    cell.arms.push_back(std::move(arm));
  }
}

void assign_to_arms(const RobotBuild& robot, Cell& cell, Findings& findings) {
  // A gripper's mimic joint may carry further joints anywhere in the tree: repeat until it settles.
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
  refuse_shared_joints(robot, cell, findings);
  if (arms.size() != robot.description->arms.size()) return;  // an arm without group was reported
  for (std::size_t a = 0; a < arms.size(); ++a) {
    read_limits(robot, robot.description->arms[a], arms[a],
                robot.pointer + "/arms/" + std::to_string(a), cell, findings);
  }
}

}  // namespace armloom

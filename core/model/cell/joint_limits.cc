#include <algorithm>
#include <set>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/model/cell/limits_of_joint.h"
#include "core/model/urdf/lacking_prefix.h"

namespace armloom {
namespace {

const ArmBuild* arm_of(const RobotBuild& robot, const Joint& joint) {
  const auto found = std::find_if(robot.arms.begin(), robot.arms.end(),
                                  [&](const ArmBuild& arm) { return arm.id == joint.arm; });
  return found == robot.arms.end() ? nullptr : &*found;
}

// Lists the names of the joints that can have limits.
std::string joints_of(const RobotTree& tree) {
  std::string names;
  for (const TreeLink& link : tree.links) {
    if (!link.joint.is_independent()) continue;
    if (names.size() > 200) return names + ", ...";
    names += (names.empty() ? "" : ", ") + link.joint.name;
  }
  return names;
}

std::string no_such_joint(const RobotBuild& robot, const ArmDescription& arm,
                          const std::string& name) {
  const std::string sentence = "arm " + arm.name + " has no joint " + name + " to limit";
  if (!robot.tree.by_joint.contains(name)) {
    const std::string meant = did_you_mean(name, robot.tree.by_joint);
    return sentence + (meant.empty() ? "; the joints of " + robot.description->name + ": " +
                                           joints_of(robot.tree)
                                     : meant);
  }
  return sentence + ": it belongs to another arm or to none, or follows another joint";
}

// Reports names in the arm's "limits" that are neither joints of the arm nor joints of its gripper.
void check_names(const RobotBuild& robot, const ArmBuild& arm, const Cell& cell,
                 Diagnostics& diagnostics) {
  for (const auto& [name, given] : arm.description->limits) {
    const std::string pointer = arm.pointer + "/limits/" + pointer_token(name);
    const auto link = robot.tree.by_joint.find(name);
    if (link != robot.tree.by_joint.end() && robot.tree.links[link->second].joint.held) {
      diagnostics.warn({ProblemKind::invalid, "fixed-joint", pointer,
                        "arm " + arm.description->name + ": the limits of " + name +
                            " have no effect, because \"fixed\" holds it",
                        name});
      continue;
    }
    if (link == robot.tree.by_joint.end() && robot.tree.nameless) continue;
    const auto joint =
        link == robot.tree.by_joint.end() ? std::nullopt : robot.joints[link->second];
    if (joint && cell.joint(*joint).arm == arm.id) continue;
    if (joint && robot.tree.patched) continue;  // the joint may be misplaced
    diagnostics.in_cell("unknown-joint", pointer, no_such_joint(robot, *arm.description, name),
                        name);
  }
}

// Reports unknown joint names in "limits" of arms whose groups were not found.
void check_names_without_group(const RobotBuild& robot, Diagnostics& diagnostics) {
  if (robot.tree.nameless) return;
  const auto& arms = robot.description->arms;
  for (std::size_t a = 0; a < arms.size(); ++a) {
    const bool found = std::any_of(robot.arms.begin(), robot.arms.end(), [&](const ArmBuild& arm) {
      return arm.description == &arms[a];
    });
    if (found) continue;
    for (const auto& [name, given] : arms[a].limits) {
      if (robot.tree.by_joint.contains(name)) continue;
      diagnostics.in_cell(
          "unknown-joint",
          robot.pointer + "/arms/" + std::to_string(a) + "/limits/" + pointer_token(name),
          no_such_joint(robot, arms[a], name), name);
    }
  }
}

// Warns of joints in joint_limits.yaml that the URDF does not have: the file is probably outdated.
// If the names only lack the URDF's prefix, says so.
void warn_of_stale_joints(const RobotBuild& robot, Diagnostics& diagnostics) {
  if (!robot.limits_file || robot.tree.nameless) return;
  std::set<std::string> all;
  for (const auto& [name, joint] : robot.limits_file->joints) all.insert(name);
  const std::string& file = robot.limits_file->file;
  if (const auto mismatch = find_prefix_mismatch({}, all, robot.tree)) {
    return diagnostics.warn({ProblemKind::invalid,
                             "other-prefix",
                             file,
                             file + ": none of its limits apply: " +
                                 to_text(*mismatch, file, "joint_limits_prefix", robot.tree),
                             {}});
  }
  std::string names;
  for (const auto& [name, joint] : robot.limits_file->joints) {
    if (robot.tree.by_joint.contains(name) || names.size() > 200) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  if (names.empty()) return;
  diagnostics.warn(
      {ProblemKind::invalid, "unknown-name", file,
       file + ": joints that are not in " + robot.tree.file + " are left out: " + names, names});
}

// If joint names of the URDF are unknown, any unknown joint in joint_limits.yaml may need its
// limits. Therefore reports all faults of such limits.
void tell_limits_without_joint(RobotBuild& robot, Diagnostics& diagnostics) {
  if (!robot.limits_file || !robot.tree.nameless) return;
  for (auto& [name, joint] : robot.limits_file->joints) {
    if (!robot.tree.by_joint.contains(name)) diagnostics.merge(std::exchange(joint.faults, {}));
  }
}

// Warns of mimic joints that move beyond their own limits within the range of the followed joint.
void warn_of_mimics(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics) {
  constexpr double kRounding = 2e-3;  // rad or m
  for (const TreeLink& link : robot.tree.links) {
    if (!link.joint.mimic) continue;
    const auto driver = robot.joints[link.joint.mimic->driver];
    if (!driver) continue;
    const Joint& followed = cell.joint(*driver);
    double from = link.joint.mimic->multiplier * followed.lower + link.joint.mimic->offset;
    double to = link.joint.mimic->multiplier * followed.upper + link.joint.mimic->offset;
    if (from > to) std::swap(from, to);
    const UrdfLimits& own = link.joint.limits;
    const bool below = own.lower && from < *own.lower - kRounding;
    const bool above = own.upper && to > *own.upper + kRounding;
    if (link.joint.motion == JointKind::continuous || !(below || above)) continue;
    const std::string place = robot.tree.place_of_joint(link);
    diagnostics.warn({ProblemKind::invalid, "mimic-beyond-limits", place,
                      place + ": it follows " +
                          robot.tree.links[link.joint.mimic->driver].joint.name + " from " +
                          text_of(from) + " to " + text_of(to) + ", beyond its own limits [" +
                          (own.lower ? text_of(*own.lower) : "-inf") + ", " +
                          (own.upper ? text_of(*own.upper) : "inf") +
                          "]: it is checked at these positions, but the robot may stop short of "
                          "them; check <mimic>",
                      below ? from : to});
  }
}

void report_needs(const ArmBuild& arm, const Needs& needs, const std::string& urdf,
                  Diagnostics& diagnostics) {
  if (needs.members.empty()) return;
  const char* none = needs.faulty ? " gives no usable limit of " : " gives no limit of ";
  const bool first = arm.description->limits.empty();
  diagnostics.in_cell(
      "limits-missing", arm.pointer + (first ? "" : "/limits"),
      "arm " + arm.description->name + ": " + urdf + none + needs.names + "; add to the arm" +
          (first ? " \"limits\": {" + needs.members + "}" : "'s \"limits\" " + needs.members) +
          ", with the robot's real limits");
}

}  // namespace

void settle_limits(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics) {
  std::map<const ArmBuild*, Needs> needs;
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    TreeLink& link = robot.tree.links[i];
    if (!robot.joints[i]) {
      diagnostics.merge_as_warnings(std::move(link.joint.limits.faults));
      continue;
    }
    Joint& joint = cell.joints[robot.joints[i]->index()];
    // A joint shared by several arms must be fixed anyway, so it needs no limits.
    const bool shared = robot.shared.contains(*robot.joints[i]);
    const ArmBuild* arm = shared ? nullptr : arm_of(robot, joint);
    const bool own =
        arm != nullptr && std::find(arm->group.begin(), arm->group.end(), i) != arm->group.end();
    LimitsFile::Joint* filed = nullptr;
    if (robot.limits_file) {
      const auto found = robot.limits_file->joints.find(link.joint.name);
      if (found != robot.limits_file->joints.end()) filed = &found->second;
    }
    LimitsOfJoint(robot, link, joint, {arm, own}, diagnostics).settle(filed, needs[arm]);
  }
  for (const ArmBuild& arm : robot.arms) {
    check_names(robot, arm, cell, diagnostics);
    report_needs(arm, needs[&arm], robot.tree.file, diagnostics);
  }
  check_names_without_group(robot, diagnostics);
  if (!robot.tree.patched) warn_of_mimics(robot, cell, diagnostics);
  warn_of_stale_joints(robot, diagnostics);
  tell_limits_without_joint(robot, diagnostics);
}

}  // namespace armloom

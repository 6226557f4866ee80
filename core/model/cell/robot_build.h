#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/model/cell.h"
#include "core/model/srdf/joint_limits_file.h"
#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// An arm while the cell is being built.
struct ArmBuild {
  ArmId id;
  std::string pointer;  // "/robots/0/arms/1"
  const ArmDescription* description;
  std::vector<std::size_t> group;  // tree indices from base to tip, with fixed joints
};

// A robot while the cell is being built: its files as read, and the ids of its links, joints and
// arms. The functions below are the steps of build_cell for one robot, in this order, each in its
// own file. Each step reports everything it finds and leaves out faulty parts, so that the next
// step can continue.
struct RobotBuild {
  RobotId id;
  std::string pointer;  // "/robots/0"
  const RobotDescription* description;
  RobotTree tree;
  std::optional<RobotSemantics> semantics;     // nullopt without a readable SRDF
  std::optional<LimitsFile> limits_file;       // nullopt without a readable file
  std::vector<LinkId> links;                   // tree index -> link of the cell
  std::vector<std::optional<JointId>> joints;  // tree index -> joint of the cell, if independent
  std::vector<ArmBuild> arms;                  // arms whose group was found
  std::set<JointId> shared;                    // joints shared by several arms; already reported

  // Returns true if the joint limits file could not be read, which was reported.
  [[nodiscard]] bool limits_unread() const {
    return !limits_file && !description->joint_limits.empty();
  }
};

// Add the robot's arms and their joints to the cell, then set the arm of each joint and link.
void add_arms(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);
void assign_to_arms(const RobotBuild& robot, Cell& cell);

// Reports movable joints on which the links of several arms depend, because each arm would move the
// other. The joints may also be upstream of the arms and in no arm's group. Remedy: fix the joint.
void refuse_shared_joints(RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Checks joints that are neither in an arm's group nor in a gripper, and thus never move. Reports
// such a joint if an arm depends on it, because its position is not given. Warns of such joints
// that move other shapes. Also warns of gripper joints between the joints of an arm's group.
void tell_standing_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Warns of joints that the SRDF declares passive although they are in an arm's group.
void warn_of_passive_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Warns of geometry that is displayed but not checked: links with <visual> but no <collision>, and
// arms without any collision shape.
void warn_of_seen_only(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Sets all limits of the robot's joints. For each limit the first source with a value applies: the
// cell file, joint_limits.yaml, the URDF, the defaults. Positions and velocities are never wider
// than the URDF's. Reports limits that an arm's own joints need and that no file gives.
void settle_limits(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);

// Sets the named states and homes of the robot's arms. Precondition: settle_limits() was called.
void settle_homes(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);

// Adds the robot's link pairs that need no check:
// - pairs within one rigid body,
// - pairs that the SRDF disables within one arm or between an arm and its mount,
// - without an SRDF, the two links of each movable joint.
// Pairs that the SRDF disables between two arms, or between an arm and its surroundings, become
// AllowedCollisions::claimed_pairs.
void allow_pairs_of_robot(const RobotBuild& robot, Cell& cell);

}  // namespace armloom

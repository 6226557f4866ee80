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
  std::vector<ArmBuild> arms;                  // with known groups
  std::set<JointId> shared;                    // by several arms; already reported

  // Returns true if the file was unreadable, as reported.
  [[nodiscard]] bool limits_unread() const {
    return !limits_file && !description->joint_limits.empty();
  }
};

// Add the robot's arms and their joints to the cell, then set the arm of each joint and link.
void add_arms(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);
void assign_to_arms(const RobotBuild& robot, Cell& cell);

// Reports joints that several arms of the robot share, also upstream joints and joints of no arm,
// because each arm would move the other. Remedy: fix the joint.
void refuse_shared_joints(RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Checks joints in no arm's group, which never move. Reports a joint that would move an arm,
// because its position is not given. Warns of joints that move other shapes, and of joints between
// those of an arm's group.
void tell_standing_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Warns of joints that are passive in the SRDF but in an arm's group.
void warn_of_passive_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Warns of geometry that is displayed but not checked: links with <visual> but no <collision>, and
// arms without any collision shape.
void warn_of_seen_only(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Sets all limits of the robot's joints. The cell file takes precedence over joint_limits.yaml, the
// URDF and the defaults. Positions and velocities are never wider than the URDF's. Reports limits
// that an arm's own joints need and no file gives.
void settle_limits(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);

// Sets the named states and homes of the robot's arms. Precondition: its limits are settled.
void settle_homes(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);

// Adds the robot's link pairs that need no check: within one rigid body, or disabled by the SRDF
// within one arm or between an arm and its mount. Without an SRDF, adds the two links of each
// movable joint. Pairs disabled for different arms, or for an arm and its surroundings, become
// AllowedCollisions::claimed_pairs.
void allow_pairs_of_robot(const RobotBuild& robot, Cell& cell);

}  // namespace armloom

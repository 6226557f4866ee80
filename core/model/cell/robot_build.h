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

// An arm on its way into the cell.
struct ArmBuild {
  ArmId id;
  std::string pointer;  // "/robots/0/arms/1"
  const ArmDescription* description;
  std::vector<std::size_t> group;  // tree indices, from base to tip, with the joints that are held
};

// A robot on its way into the cell: its files as read, and where its links, joints and arms went.
// The functions below are the steps of build_cell for one robot, each in a file of its own, in this
// order. Each tells all that it finds and leaves out what cannot be, so that the next can go on.
struct RobotBuild {
  RobotId id;
  std::string pointer;  // "/robots/0"
  const RobotDescription* description;
  RobotTree tree;
  std::optional<RobotSemantics> semantics;     // none: the robot has no SRDF
  std::optional<LimitsFile> limits_file;       // none: it has no file of joint limits
  std::vector<LinkId> links;                   // tree index -> link of the cell
  std::vector<std::optional<JointId>> joints;  // tree index -> joint of the cell, if independent
  std::vector<ArmBuild> arms;                  // those whose groups could be found
  std::set<JointId> shared;                    // joints that move several arms, which is told

  // Its file of joint limits, which is told: what it says of a joint is not known.
  [[nodiscard]] bool limits_unread() const {
    return !limits_file && !description->joint_limits.empty();
  }
};

// Adds the robot's arms to the cell, with their joints; then settles which arm each joint and link
// belongs to.
void add_arms(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);
void assign_to_arms(const RobotBuild& robot, Cell& cell);

// Arms of one robot must not move each other: a shared joint, also upstream and also one of no arm,
// is a problem, which holding the joint solves.
void refuse_shared_joints(RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Joints of no arm stand still. One that would move an arm is a problem, as nobody has said where
// it stands; others that move shapes, or stand between joints of an arm's group, are warned of.
void tell_standing_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Warns of joints that the SRDF has as passive and an arm's group holds.
void warn_of_passive_joints(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Warns of what is seen and not checked: links with a visual and without a collision shape, and
// arms without any shape.
void warn_of_seen_only(const RobotBuild& robot, const Cell& cell, Diagnostics& diagnostics);

// Settles every limit of the robot's joints, from the cell file's `limits` over joint_limits.yaml
// over the URDF and the defaults. Positions and velocities are never wider than the URDF's. What an
// arm's own joints need and no file gives is a problem.
void settle_limits(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);

// Named states and homes of the robot's arms. Precondition: its limits are settled.
void settle_homes(RobotBuild& robot, Cell& cell, Diagnostics& diagnostics);

// Adds the pairs of the robot's links that need no check: those within one rigid body and those
// that the SRDF disables within one arm or between an arm and its mount. Without an SRDF also links
// on both sides of one movable joint. Other pairs of the SRDF become
// AllowedCollisions::claimed_pairs.
void allow_pairs_of_robot(const RobotBuild& robot, Cell& cell);

}  // namespace armloom

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/model/findings.h"
#include "core/model/robot_tree.h"
#include "core/model/srdf_reader.h"

namespace armloom {

// A robot on its way into the cell: its files as read, and where its links and joints went. The
// functions below are the steps of build_cell for one robot, each in a file of its own.
struct RobotBuild {
  RobotId id;
  std::string pointer;  // "/robots/0"
  const RobotDescription* description;
  RobotTree tree;
  std::optional<RobotSemantics> semantics;     // none: the robot has no SRDF
  std::vector<LinkId> links;                   // tree index -> link of the cell
  std::vector<std::optional<JointId>> joints;  // tree index -> joint of the cell, if independent
};

// Adds the robot's arms to the cell, with joints, home, limits and named states; then settles which
// arm each joint and link belongs to. Arms of one robot must not move each other: a shared joint,
// also upstream and also one of no arm, is a problem.
void add_arms(const RobotBuild& robot, Cell& cell, Findings& findings);
void assign_to_arms(const RobotBuild& robot, Cell& cell, Findings& findings);

// Adds the pairs of the robot's links that need no check: those of the SRDF and those within one
// rigid body. Without an SRDF also links on both sides of one movable joint.
void allow_pairs_of_robot(const RobotBuild& robot, Cell& cell);

}  // namespace armloom

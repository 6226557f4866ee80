#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/model/cell_description.h"
#include "server/import/arm_groups.h"
#include "server/import/import_cell.h"
#include "server/import/packages.h"

namespace armloom {

// A joint to be fixed at `value`. `state`: the SRDF state with this value; empty for zero.
struct HeldJoint {
  std::string name;
  double value;
  std::string state;
};

struct ImportedRobot {
  RobotFiles files;
  std::string name;                   // from the URDF
  std::vector<std::string> arms;      // groups, in SRDF order
  std::vector<GroupChoice> left_out;  // groups that are not arms
  std::vector<HeldJoint> held;        // joints above arms, in no arm or in several
  // For each arm in `arms`: guesses of missing limits, by name of the moving joint.
  std::vector<std::map<std::string, JointLimitsDescription>> guesses;
  Packages packages;
};

// Reads a robot's files and selects its arms. Problems: faults of the files, or no group is an arm.
[[nodiscard]] Result<ImportedRobot> read_imported_robot(
    const RobotFiles& files, const std::map<std::string, std::string>& packages);

}  // namespace armloom

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

// A joint that is to be held, and the state of the SRDF that says where; none: at zero.
struct HeldJoint {
  std::string name;
  double value;
  std::string state;
};

// What an import takes from one robot's files.
struct ImportedRobot {
  RobotFiles files;
  std::string name;                   // as the URDF has it
  std::vector<std::string> arms;      // groups, in the order of the SRDF
  std::vector<GroupChoice> left_out;  // groups that are no arms
  std::vector<HeldJoint> held;        // joints above the arms that are in none or in several
  // Limits that no file gives, for each of `arms`, by joint that is left to move.
  std::vector<std::map<std::string, JointLimitsDescription>> guesses;
  Packages packages;
};

// Problems: what is wrong with the files; no group is an arm.
[[nodiscard]] Result<ImportedRobot> read_imported_robot(
    const RobotFiles& files, const std::map<std::string, std::string>& packages);

}  // namespace armloom

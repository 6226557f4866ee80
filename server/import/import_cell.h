#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "server/import/placement.h"

namespace armloom {

// A robot as MoveIt has it.
struct RobotFiles {
  std::filesystem::path urdf;
  std::filesystem::path srdf;
  std::filesystem::path joint_limits;  // empty: none
};

struct ImportRequest {
  std::string cell;               // its name; empty: of the robots
  std::vector<RobotFiles> files;  // one for all robots, or one for each
  std::vector<Placement> robots;  // empty: one for each of `files`, called as its URDF says
  std::string prefix;             // of a single robot; several have their names as prefixes
  std::map<std::string, std::string> packages;  // package -> folder; others are looked for
  // Paths in the cell file are relative to this folder; none: they are absolute.
  std::optional<std::filesystem::path> folder;
};

struct ImportedCell {
  std::string text;                  // of a cell file, with comments
  std::vector<std::string> remarks;  // what was chosen, guessed or not found; in the comments, too
};

// A cell file for robots described by URDF and SRDF: their arms (choose_arm_groups), homes
// (choose_homes), joints held above arms, the folders of packages, and every setting at its
// default. It need not load: what is wrong with it, load_cell says. Problems: the files cannot be
// read, or no group is an arm; prefixes or numbers of files that do not fit together, at the option
// of the command line.
[[nodiscard]] Result<ImportedCell> import_cell(const ImportRequest& request);

}  // namespace armloom

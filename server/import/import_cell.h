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

// A robot's files, as for MoveIt.
struct RobotFiles {
  std::filesystem::path urdf;
  std::filesystem::path srdf;
  std::filesystem::path joint_limits;  // may be empty
  // As RobotDescription::srdf_prefix and joint_limits_prefix.
  std::string srdf_prefix = {};
  std::string joint_limits_prefix = {};
};

struct ImportRequest {
  std::string cell;               // name; if empty, made from the robots' names
  std::vector<RobotFiles> files;  // one for all robots, or one for each
  std::vector<Placement> robots;  // if empty: one for each of `files`, named by its URDF
  std::string prefix;  // for the names of a single robot; several robots use their own names
  std::map<std::string, std::string> packages;  // folder by package; others are searched
  // Paths in the cell file are relative to this folder; absolute if nullopt.
  std::optional<std::filesystem::path> folder;
};

struct ImportedCell {
  std::string text;                  // of a cell file, with comments
  std::vector<std::string> remarks;  // choices, guesses and missing files; also in the comments
};

// Returns a cell file for robots with URDF and SRDF: arms (choose_arm_groups), homes
// (choose_homes), fixed joints, package folders and default settings. load_cell() may still refuse
// the file. Problems: the files cannot be read; no group is an arm; prefixes or numbers of files do
// not fit together (the problem names the command-line option).
[[nodiscard]] Result<ImportedCell> import_cell(const ImportRequest& request);

}  // namespace armloom

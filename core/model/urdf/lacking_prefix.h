#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "core/model/urdf/robot_tree.h"

namespace armloom {

// How the names in another file differ from those in the URDF.
struct PrefixMismatch {
  std::set<std::string> lacking;     // prefixes that the other file lacks: "ur_"
  std::optional<std::string> extra;  // a prefix that the URDF lacks
  std::size_t fitting = 0;           // names that fit with the prefix, or without the extra one
  std::size_t names = 0;             // all names
};

// Compares link and joint names of another file with the URDF. Returns nullopt if more than half of
// them are in the URDF, or if fewer than nine in ten fit with a common prefix. `lacking` has
// several prefixes if the URDF has the robot several times.
[[nodiscard]] std::optional<PrefixMismatch> find_prefix_mismatch(
    const std::set<std::string>& links, const std::set<std::string>& joints, const RobotTree& tree);

// Returns the sentence about the names of a file, with the remedy: the line `"KEY": "ur_"` in the
// cell file.
[[nodiscard]] std::string to_text(const PrefixMismatch& mismatch, const std::string& file,
                                  const std::string& key, const RobotTree& tree);

}  // namespace armloom

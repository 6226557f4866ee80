#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Bounds the pairs of links that are stored and checked.
inline constexpr std::size_t kMaxLinksOfRobot = 1000;

// Reads a URDF that was loaded from `path`; places are "panda.urdf:12: joint panda_joint3". After
// faults, the tree holds what could be read, so that the rest of the cell can be checked. Returns
// nullopt if the text is not XML, has too many links, or is refused by urdfdom. Meshes are resolved
// (mesh_path.h), not loaded.
[[nodiscard]] std::optional<RobotTree> read_urdf(std::string text,
                                                 const std::filesystem::path& path,
                                                 const std::map<std::string, std::string>& packages,
                                                 Diagnostics& diagnostics);

// Returns the tree for an unreadable URDF: only the file's name.
[[nodiscard]] RobotTree unread_robot(const std::filesystem::path& path);

}  // namespace armloom

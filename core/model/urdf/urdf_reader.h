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

// Reads a URDF that was loaded from `path`. Places in messages look like "panda.urdf:12: joint
// panda_joint3". If the URDF has faults, the tree contains the parts that could be read, so that
// the rest of the cell can be checked. Returns nullopt if the text is not XML, has too many links,
// or is refused by urdfdom. Mesh names are resolved to paths (mesh_path.h), but meshes are not
// loaded.
[[nodiscard]] std::optional<RobotTree> read_urdf(std::string text,
                                                 const std::filesystem::path& path,
                                                 const std::map<std::string, std::string>& packages,
                                                 Diagnostics& diagnostics);

// Returns the tree of an unreadable URDF, which has a file name but no links.
[[nodiscard]] RobotTree unread_robot(const std::filesystem::path& path);

}  // namespace armloom

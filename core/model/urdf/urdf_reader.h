#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// Maximum number of links of a robot, because pairs of links are stored and checked.
inline constexpr std::size_t kMaxLinksOfRobot = 1000;

// Reads a URDF that was loaded from `path`; places are "panda.urdf:12: joint panda_joint3". Faults
// go to `diagnostics`, and the robot is read as far as possible, so that the rest of the cell can
// be checked, too. The tree is as intended only if no problem was added. Returns nullopt if the
// text is not XML, has too many links, or is refused by urdfdom. Meshes are resolved (mesh_path.h)
// but not loaded.
[[nodiscard]] std::optional<RobotTree> read_urdf(std::string text,
                                                 const std::filesystem::path& path,
                                                 const std::map<std::string, std::string>& packages,
                                                 Diagnostics& diagnostics);

// Returns an empty tree, with the file's name, for a URDF that cannot be read.
[[nodiscard]] RobotTree unread_robot(const std::filesystem::path& path);

}  // namespace armloom

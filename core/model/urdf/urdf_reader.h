#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/urdf/robot_tree.h"

namespace armloom {

// A robot has at most this many links: pairs of links are stored and checked.
inline constexpr std::size_t kMaxLinksOfRobot = 1000;

// Reads a URDF that was loaded from `path`; places are "panda.urdf: joint panda_joint3". All that
// is wrong goes to `diagnostics`, and the robot is read as far as it can be, so that what else is
// wrong with the cell can be told at once: the tree only holds what was meant when nothing was
// added. Nothing when the text is no XML, or of too many links. Meshes are resolved (see
// mesh_path.h) and not loaded (build_cell does).
[[nodiscard]] std::optional<RobotTree> read_urdf(std::string text,
                                                 const std::filesystem::path& path,
                                                 const std::map<std::string, std::string>& packages,
                                                 Diagnostics& diagnostics);

// What is known of a robot whose URDF cannot be read: nothing but the file's name.
[[nodiscard]] RobotTree unread_robot(const std::filesystem::path& path);

}  // namespace armloom

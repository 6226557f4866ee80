#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/model/findings.h"
#include "core/model/robot_tree.h"

namespace armloom {

// Reads a URDF that was loaded from `path`. Nothing, with the reasons in `findings`, when anything
// in it is wrong; places are "panda.urdf: joint panda_joint3". Meshes are resolved (see
// mesh_path.h) and not loaded (build_cell does).
[[nodiscard]] std::optional<RobotTree> read_urdf(std::string text,
                                                 const std::filesystem::path& path,
                                                 const std::map<std::string, std::string>& packages,
                                                 Findings& findings);

}  // namespace armloom

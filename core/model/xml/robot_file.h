#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"

namespace armloom {

// Loads a robot's URDF, SRDF or joint limits file, which must be UTF-8, and expands .xacro
// (xacro.h). Returns nullopt, with the reasons in `diagnostics`, if loading fails. `whose` begins
// the message ("robot left").
[[nodiscard]] std::optional<std::string> load_robot_file(const std::filesystem::path& path,
                                                         const std::string& pointer,
                                                         const std::string& whose,
                                                         Diagnostics& diagnostics);

// Returns the file name as in messages, without folder. A .xacro file is marked as "arm.urdf.xacro
// (expanded)", because line numbers refer to the expanded text.
[[nodiscard]] std::string told_file_name(const std::filesystem::path& path);

}  // namespace armloom

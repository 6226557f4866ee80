#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"

namespace armloom {

// Loads the text of a robot's file (URDF, SRDF or joint limits), which must be UTF-8. A file named
// .xacro is expanded first (xacro.h). Returns nullopt, with the reasons in `diagnostics`, if
// loading fails. `whose` begins the sentence ("robot left").
[[nodiscard]] std::optional<std::string> load_robot_file(const std::filesystem::path& path,
                                                         const std::string& pointer,
                                                         const std::string& whose,
                                                         Diagnostics& diagnostics);

// Returns the file's name without folder, with which places in the file begin. For xacro, line
// numbers refer to the expanded text, which the name states: "arm.urdf.xacro (expanded)".
[[nodiscard]] std::string told_file_name(const std::filesystem::path& path);

}  // namespace armloom

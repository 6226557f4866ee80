#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"

namespace armloom {

// Loads a robot's URDF, SRDF or joint limits file, which must be UTF-8, and expands .xacro
// (xacro.h). Returns nullopt, with the reasons in `diagnostics`, if loading fails. `whose` begins
// the sentence ("robot left").
[[nodiscard]] std::optional<std::string> load_robot_file(const std::filesystem::path& path,
                                                         const std::string& pointer,
                                                         const std::string& whose,
                                                         Diagnostics& diagnostics);

// Returns the beginning of places: the name without folder. For xacro, lines refer to the expanded
// text: "arm.urdf.xacro (expanded)".
[[nodiscard]] std::string told_file_name(const std::filesystem::path& path);

}  // namespace armloom

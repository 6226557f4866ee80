#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/diagnostics.h"

namespace armloom {

// The text of a robot's file: URDF, SRDF or joint limits, UTF-8. A name that ends in .xacro is
// expanded first (xacro.h). Nothing, with the reasons in `diagnostics`, when it cannot be had;
// pointer and the sentence's beginning ("robot left") as given.
[[nodiscard]] std::optional<std::string> load_robot_file(const std::filesystem::path& path,
                                                         const std::string& pointer,
                                                         const std::string& whose,
                                                         Diagnostics& diagnostics);

// As places in such a file begin: its name without folder. Of xacro the lines are those of what it
// expands to, which is said: "arm.urdf.xacro (expanded)".
[[nodiscard]] std::string told_file_name(const std::filesystem::path& path);

}  // namespace armloom

#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

inline constexpr std::chrono::seconds kXacroTime(30);

// Runs the program `xacro` on a file and returns what it prints: URDF or SRDF. No shell; it is
// ended after `at_most`, and at kMaxRobotFileBytes of output. xacro evaluates expressions and
// reads the files that it is told to include: only files that a cell names itself are expanded. The
// error is half a sentence for "cannot expand <file>: ...", and says what to do by hand when xacro
// is not installed.
[[nodiscard]] tl::expected<std::string, std::string> expand_xacro(
    const std::filesystem::path& file, std::chrono::seconds at_most = kXacroTime);

}  // namespace armloom

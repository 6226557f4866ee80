#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

inline constexpr std::chrono::seconds kXacroTime(30);

struct ExpandedXacro {
  std::string text;  // standard output: URDF or SRDF
  std::string said;  // its warnings in one line; usually empty
};

// Runs the program `xacro` on a file, without a shell. It is killed after `at_most` or
// kMaxRobotFileBytes of output. Warning: xacro evaluates expressions and reads included files, so
// expand only files that a cell names. The error continues the sentence "cannot expand <file>: ..."
// with xacro's message, or with a manual remedy if xacro is not installed.
[[nodiscard]] tl::expected<ExpandedXacro, std::string> expand_xacro(
    const std::filesystem::path& file, std::chrono::seconds at_most = kXacroTime);

}  // namespace armloom

#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

inline constexpr std::chrono::seconds kXacroTime(30);

struct ExpandedXacro {
  std::string text;  // URDF or SRDF
  std::string said;  // warnings in one line; usually empty
};

// Runs `xacro` without a shell; kills it after `at_most` or kMaxRobotFileBytes of output. xacro
// evaluates expressions and reads included files, so expand only files that a cell file names. The
// error text continues the sentence "cannot expand <file>: ..." with xacro's message or a remedy.
[[nodiscard]] tl::expected<ExpandedXacro, std::string> expand_xacro(
    const std::filesystem::path& file, std::chrono::seconds at_most = kXacroTime);

}  // namespace armloom

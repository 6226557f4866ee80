#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <tl/expected.hpp>

namespace armloom {

inline constexpr std::chrono::seconds kXacroTime(30);

struct ExpandedXacro {
  std::string text;  // what it printed: URDF or SRDF
  std::string said;  // its warnings in one line, most often empty
};

// Runs the program `xacro` on a file. No shell; it is ended after `at_most`, and at
// kMaxRobotFileBytes of output. xacro evaluates expressions and reads the files that it is told to
// include: only files that a cell names itself are expanded. The error is half a sentence for
// "cannot expand <file>: ...", with all that xacro says, and what to do by hand when it is not
// installed.
[[nodiscard]] tl::expected<ExpandedXacro, std::string> expand_xacro(
    const std::filesystem::path& file, std::chrono::seconds at_most = kXacroTime);

}  // namespace armloom

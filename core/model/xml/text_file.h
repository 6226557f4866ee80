#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/base/problem.h"

namespace armloom {

inline constexpr std::size_t kMaxRobotFileBytes = std::size_t{16} << 20;

// The whole file as text. A Problem, with pointer and the sentence's beginning ("robot left") as
// given, when it is no regular file (a pipe would block), cannot be read, is longer than
// kMaxRobotFileBytes or holds a zero byte (at which XML libraries stop reading).
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path,
                                                 const std::string& pointer,
                                                 const std::string& whose);

}  // namespace armloom

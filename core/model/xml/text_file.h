#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/base/problem.h"

namespace armloom {

inline constexpr std::size_t kMaxRobotFileBytes = std::size_t{16} << 20;

// Returns the whole file. Fails if it is not a regular file (a pipe would block), is unreadable, is
// longer than kMaxRobotFileBytes, or contains a zero byte (at which XML libraries stop). `whose`
// begins the sentence ("robot left").
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path,
                                                 const std::string& pointer,
                                                 const std::string& whose);

}  // namespace armloom

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/base/problem.h"

namespace armloom {

inline constexpr std::size_t kMaxRobotFileBytes = std::size_t{16} << 20;

// Returns the content of the file. It must be a regular file (a pipe would block) of at most
// kMaxRobotFileBytes and without zero bytes (at which XML libraries stop). `whose` begins the
// message ("robot left").
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path,
                                                 const std::string& pointer,
                                                 const std::string& whose);

}  // namespace armloom

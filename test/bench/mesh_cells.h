#pragma once

#include <filesystem>
#include <vector>

#include "core/model/cell.h"
#include "core/model/kinematics.h"

namespace armloom::bench {

// Throws the first problem if the file cannot be loaded.
[[nodiscard]] CellPtr cell_of_file(const std::filesystem::path& path);

[[nodiscard]] CellPtr two_shuttles();

// Returns two six-link arms face to face, 0.9 m apart, whose links are U-shaped channels of 400
// triangles. Written as STL and URDF and loaded, like any robot.
[[nodiscard]] CellPtr two_channel_arms();

// Returns random states within the limits. `near`: link frames of different arms are closer than
// 0.3 m, independent of distance computations.
[[nodiscard]] std::vector<Configuration> random_states(const Cell& cell, std::size_t count,
                                                       bool near);

}  // namespace armloom::bench

#pragma once

#include <filesystem>
#include <vector>

#include "core/model/cell.h"
#include "core/model/kinematics.h"

namespace armloom::bench {

// Returns the cell of such a file; throws the first problem if it cannot be loaded.
[[nodiscard]] CellPtr cell_of_file(const std::filesystem::path& path);

// Returns config/two_shuttles.json.
[[nodiscard]] CellPtr two_shuttles();

// Returns two six-link arms face to face 0.9 m apart. Each link is a U-shaped channel of 400
// triangles that convex pieces approximate well. Written as STL and URDF into a temporary folder
// and loaded from there, like any robot.
[[nodiscard]] CellPtr two_channel_arms();

// Returns random states, uniform within the limits. `near`: only states in which link frames of
// different arms are closer than 0.3 m. Using frames keeps the states independent of distance
// computations.
[[nodiscard]] std::vector<Configuration> random_states(const Cell& cell, std::size_t count,
                                                       bool near);

}  // namespace armloom::bench

#pragma once

#include <filesystem>
#include <vector>

#include "core/model/cell.h"
#include "core/model/kinematics.h"

namespace armloom::bench {

// The cell of such a file; throws with the first fault where it does not load.
[[nodiscard]] CellPtr cell_of_file(const std::filesystem::path& path);

// config/two_shuttles.json
[[nodiscard]] CellPtr two_shuttles();

// Two arms of six links face to face 0.9 m apart, each link a U-shaped channel of 400 triangles
// that convex pieces follow well. Written as STL and URDF into a temporary folder and read from
// there, as any user's robot is.
[[nodiscard]] CellPtr two_channel_arms();

// Random states, uniform within the limits. `near`: only such in which frames of links of
// different arms are closer than 0.3 m; by frames, so that the states do not depend on how
// distances are measured.
[[nodiscard]] std::vector<Configuration> random_states(const Cell& cell, std::size_t count,
                                                       bool near);

}  // namespace armloom::bench

#pragma once

#include <cstddef>

#include "core/model/cell.h"

namespace armloom::bench {

// These functions build cells from the Pandas of config/two_pandas.json. They throw
// std::runtime_error if a file cannot be read.

[[nodiscard]] CellPtr two_pandas();

// Returns one Panda among ten boxes and ten spheres, without a table. Their sizes are 0.1 to 0.2 m
// and their places random, 0.4 to 0.9 m from the arm's shoulder. If `contact`, all clearances and
// the tracking error are 0.
[[nodiscard]] CellPtr panda_among_objects(bool contact);

// Returns `count` Pandas evenly on a circle, facing its center, on one table.
[[nodiscard]] CellPtr circle_of_pandas(std::size_t count, double radius_m);

// Returns `count` Pandas along x, facing +y, on one long table, in the order of x.
[[nodiscard]] CellPtr line_of_pandas(std::size_t count, double spacing_m);

// Returns `rows` such lines, one behind the other along y. Arms are in the order of y, then x.
[[nodiscard]] CellPtr grid_of_pandas(std::size_t columns, std::size_t rows, double spacing_m);

}  // namespace armloom::bench

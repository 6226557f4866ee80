#pragma once

#include <cstddef>

#include "core/model/cell.h"

namespace armloom::bench {

// These functions build cells from the Pandas of config/two_pandas.json. They throw
// std::runtime_error if a file cannot be read.

[[nodiscard]] CellPtr two_pandas();

// Returns `count` Pandas evenly on a circle, facing its center, on one table.
[[nodiscard]] CellPtr circle_of_pandas(std::size_t count, double radius_m);

// Returns `count` Pandas along x, facing +y, on one long table, in the order of x.
[[nodiscard]] CellPtr line_of_pandas(std::size_t count, double spacing_m);

// Returns `rows` such lines, one behind the other along y. Arms are in the order of y, then x.
[[nodiscard]] CellPtr grid_of_pandas(std::size_t columns, std::size_t rows, double spacing_m);

}  // namespace armloom::bench

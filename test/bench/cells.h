#pragma once

#include <cstddef>

#include "core/model/cell.h"

namespace armloom::bench {

// The cells of the benchmarks, built from the Pandas of config/two_pandas.json. Throw
// std::runtime_error with the problem if a file cannot be read.

// Returns config/two_pandas.json itself.
[[nodiscard]] CellPtr two_pandas();

// Returns `count` Pandas with their bases evenly on a circle of that radius, facing its center, on
// one table.
[[nodiscard]] CellPtr circle_of_pandas(std::size_t count, double radius_m);

// Returns a hall: `count` Pandas along x, `spacing_m` apart, all facing +y, on one long table. Arms
// are in the order of x.
[[nodiscard]] CellPtr line_of_pandas(std::size_t count, double spacing_m);

// Returns a wide hall: rows of such lines, all arms facing +y; arms are in the order of y, then x.
[[nodiscard]] CellPtr grid_of_pandas(std::size_t columns, std::size_t rows, double spacing_m);

}  // namespace armloom::bench

#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/model/cell.h"

namespace armloom::test {

// Reads a cell file. Throws std::runtime_error if the file has a fault.
[[nodiscard]] CellPtr cell_in(const std::filesystem::path& file);

// Returns a cell of config/, by its file name without ".json".
[[nodiscard]] CellPtr config_cell(const std::string& name);

// Returns the names of all cells in config/.
[[nodiscard]] std::vector<std::string> config_cell_names();

// Returns a configuration within the joints' limits.
[[nodiscard]] Configuration random_configuration(const Cell& cell, std::mt19937_64& random);

}  // namespace armloom::test

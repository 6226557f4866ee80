#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/model/cell_description.h"

namespace armloom {

// Reads a cell file (JSON with // and /* */ comments) as plain data. Returns all problems, each
// with a JSON pointer: unknown keys, wrong types, numbers out of range. Resolves relative paths
// against `folder`. Does not open the robots' files.
[[nodiscard]] Result<CellDescription> read_cell_text(std::string_view text,
                                                     const std::filesystem::path& folder);

// Reads as much as possible. `faults` must be empty before; faulty members keep their defaults.
[[nodiscard]] CellDescription read_cell_text(std::string_view text,
                                             const std::filesystem::path& folder, Problems& faults);

// Returns the cell file without comments and with every path replaced by path_of(path resolved
// against `folder`). Precondition: read_cell_text(text, folder) succeeded.
[[nodiscard]] std::string with_cell_paths(
    std::string_view text, const std::filesystem::path& folder,
    const std::function<std::string(const std::filesystem::path&)>& path_of);

}  // namespace armloom

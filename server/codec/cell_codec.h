#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/model/cell_description.h"

namespace armloom {

// Reads a cell file (JSON with comments). Returns all problems, with JSON pointers. Resolves
// relative paths against `folder`. Does not open the files of the robots.
[[nodiscard]] Result<CellDescription> read_cell_text(std::string_view text,
                                                     const std::filesystem::path& folder);

// Reads as much as possible and adds the problems to `faults`. Faulty members keep their defaults.
// Precondition: `faults` is empty.
[[nodiscard]] CellDescription read_cell_text(std::string_view text,
                                             const std::filesystem::path& folder, Problems& faults);

// Returns the text of a cell file with each path p replaced by path_of(p resolved against
// `folder`), and without comments. Precondition: read_cell_text(text, folder) succeeded.
[[nodiscard]] std::string with_cell_paths(
    std::string_view text, const std::filesystem::path& folder,
    const std::function<std::string(const std::filesystem::path&)>& path_of);

}  // namespace armloom

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/model/cell_description.h"

namespace armloom {

// A cell file (JSON, // and /* */ comments allowed) as plain data. Strict: unknown keys, wrong
// types and numbers out of range are problems, places are JSON pointers into the file, all are
// returned. Relative paths are resolved against `folder`. Robots' files are not opened.
[[nodiscard]] Result<CellDescription> read_cell_text(std::string_view text,
                                                     const std::filesystem::path& folder);

// The same as far as it can be read: what is wrong is in `faults` (empty before), and left at its
// default in the description.
[[nodiscard]] CellDescription read_cell_text(std::string_view text,
                                             const std::filesystem::path& folder, Problems& faults);

// The same cell file with other paths, comments lost: what `path_of` says of each, which is
// resolved against `folder`. Precondition: read_cell_text(text, folder) succeeded.
[[nodiscard]] std::string with_cell_paths(
    std::string_view text, const std::filesystem::path& folder,
    const std::function<std::string(const std::filesystem::path&)>& path_of);

}  // namespace armloom

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/audit/recorded_scene.h"
#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// Reads the `scene` events of events.jsonl, in their order. Returns none if the file is missing.
// Meshes are those of the cell's objects with the same names. Problems name "events.jsonl:LINE" and
// a JSON pointer. `warnings`, if given, gets a sentence on a last line without line end (this line
// is ignored).
[[nodiscard]] Result<std::vector<RecordedScene>> read_scenes(
    const std::filesystem::path& folder, const Cell& cell,
    std::vector<std::string>* warnings = nullptr);

}  // namespace armloom

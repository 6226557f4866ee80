#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"
#include "server/codec/json_writer.h"

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

// The same cell file for another place: every path in it made relative to `to`, comments lost.
// Precondition: read_cell_text(text, from) succeeded.
[[nodiscard]] std::string relocate_cell_text(std::string_view text,
                                             const std::filesystem::path& from,
                                             const std::filesystem::path& to);

// The answer to GET /cell, with URDF and SRDF texts, and for each robot the addresses of the meshes
// that its URDF names ("meshes", by the name there). `policy` and `speed` are those in force.
[[nodiscard]] std::string cell_json(const Cell& cell, std::string_view policy, double speed);

// The body of POST and PUT /scene/objects: an object as in a cell file, but no mesh: a client names
// no file of the server. `name`: of the URL, which one in the body has to agree with.
inline constexpr std::size_t kObjectNameMax = 128;
[[nodiscard]] Result<CollisionObject> read_object_text(std::string_view text,
                                                       const std::optional<std::string>& name);

void write_object(JsonWriter& out, const CollisionObject& object);
// An array of objects of the planning scene.
void write_objects(JsonWriter& out, const std::vector<CollisionObject>& objects);

}  // namespace armloom

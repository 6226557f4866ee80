#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// Objects of the planning scene over HTTP.
// Bodies of POST /scene/objects and of PUT. In a PUT the name is in the path; a name in the body
// must agree. Objects are as in a cell file, but without meshes, because a client cannot name files
// of the server.

// The body of POST /scene/objects, and with a name of the URL, which one in the body has to agree
// with, of PUT: an object as in a cell file, but no mesh: a client names no file of the server.
[[nodiscard]] FormatPtr<ObjectDescription> object_request_format();
[[nodiscard]] FormatPtr<ObjectDescription> named_object_request_format();
[[nodiscard]] Result<CollisionObject> read_object_text(std::string_view text,
                                                       const std::optional<std::string>& name);

[[nodiscard]] bool has_object(const std::vector<CollisionObject>& objects, std::string_view name);

// An object with the path of its mesh instead of the file. Objects without a mesh read back
// exactly, except for rounding of angles.
[[nodiscard]] FormatPtr<CollisionObject> object_format();
[[nodiscard]] FormatPtr<SceneView> scene_format();

// Answers to changes of the scene.
struct SceneChange {
  std::uint64_t version;
  CollisionObject object;
};
[[nodiscard]] FormatPtr<SceneChange> scene_change_format();
[[nodiscard]] FormatPtr<std::uint64_t> scene_version_format();

}  // namespace armloom

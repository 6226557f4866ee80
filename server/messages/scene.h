#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/number_range.h"
#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/executive/events.h"
#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// Bodies of POST /scene/objects and PUT /scene/objects/{name}. If a body of PUT has a name, it must
// be the name in the path. Meshes are refused, because a client must not name files of the server.

[[nodiscard]] FormatPtr<ObjectDescription> object_request_format();
[[nodiscard]] FormatPtr<ObjectDescription> named_object_request_format();
[[nodiscard]] Result<CollisionObject> read_object_text(std::string_view text,
                                                       const std::optional<std::string>& name);

// Body of PUT /scene.
struct SceneRequest {
  inline static constexpr NumberRange padding_range{0.0, 10.0};
  inline static constexpr NumberRange expires_in_range{0.0, 1e6, true};

  std::vector<ObjectDescription> objects;
  std::optional<std::uint64_t> version;  // the version that the client expects
  double padding_m = 0.0;
  std::optional<Duration> expires_in;
};
[[nodiscard]] FormatPtr<SceneRequest> scene_request_format();
struct ReadScene {
  std::shared_ptr<const std::vector<CollisionObject>> objects;
  std::vector<std::string> texts;  // of the objects, as JSON
  std::optional<std::uint64_t> version;
  std::optional<Duration> expires_in;
};
// The objects and texts include the padding: all sides of a box, and the radius and both ends of a
// cylinder or sphere, are moved outward by padding_m. The result contains all points that are
// within padding_m of the shape. Problems: those of the format; an object that becomes too large.
[[nodiscard]] Result<ReadScene> read_scene_text(std::string_view text);

[[nodiscard]] bool has_object(const std::vector<CollisionObject>& objects, std::string_view name);

// Describes an object of the scene. A mesh is written as a path on the server instead of its file.
// Objects without a mesh can be read back, up to rounding of angles.
[[nodiscard]] FormatPtr<CollisionObject> object_format();
[[nodiscard]] FormatPtr<SceneView> scene_format();
[[nodiscard]] FormatPtr<HeldView> held_format();

// Answers to changes of the scene.
struct SceneChange {
  std::uint64_t version;
  CollisionObject object;
};
[[nodiscard]] FormatPtr<SceneChange> scene_change_format();
[[nodiscard]] FormatPtr<std::uint64_t> scene_version_format();

}  // namespace armloom

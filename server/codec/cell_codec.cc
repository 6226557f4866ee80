#include "server/codec/cell_codec.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/cell_format.h"
#include "server/codec/json_text.h"
#include "server/codec/scene_format.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

std::string resolved(const std::string& path, const fs::path& folder) {
  return (fs::path(path).is_absolute() ? fs::path(path) : folder / path)
      .lexically_normal()
      .string();
}

}  // namespace

Result<CollisionObject> read_object_text(std::string_view text,
                                         const std::optional<std::string>& name) {
  auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  if (name && body->is_object() && !body->contains("name")) (*body)["name"] = *name;
  const JsonNode node(*body, "", faults);
  ObjectDescription object;
  if (node.is_object() && node.has("mesh")) {
    node.optional("mesh", [](const JsonNode& n) {
      n.invalid("unsupported",
                "meshes are part of the cell file; over HTTP an object is a box, a "
                "cylinder or a sphere");
    });
  } else {
    scene_object_format()->read(node, object);
  }
  node.optional("name", [&](const JsonNode& n) {
    const bool plain = std::ranges::none_of(object.name,
                                            [](char c) {
                                              return static_cast<unsigned char>(c) < 0x20 ||
                                                     c == 0x7f || c == '/' || c == '\\';
                                            }) &&
                       object.name != "." && object.name != "..";
    if (object.name.size() > kObjectNameMax || !plain) {
      n.invalid(
          "bad-name",
          "a name is at most 128 bytes without slashes and control characters, and not . or ..");
    } else if (name && n.raw().is_string() && n.raw() != *name) {
      n.invalid("name-differs", "the name differs from \"" + *name + "\" in the address");
    }
  });
  if (!faults.empty()) return failure(std::move(faults));
  return CollisionObject{std::move(object.name), object.shape, object.X_WO};
}

Result<CellDescription> read_cell_text(std::string_view text, const fs::path& folder) {
  Problems faults;
  CellDescription cell = read_cell_text(text, folder, faults);
  if (!faults.empty()) return failure(std::move(faults));
  return cell;
}

CellDescription read_cell_text(std::string_view text, const fs::path& folder, Problems& faults) {
  CellDescription cell;
  auto file = parse_json(text, JsonComments::allowed);
  if (!file) {
    faults = file.error();
    return cell;
  }
  cell_format().map_paths(*file, [&](const std::string& path) { return resolved(path, folder); });
  cell_format().read(JsonNode(*file, "", faults), cell);
  return cell;
}

std::string relocate_cell_text(std::string_view text, const fs::path& from, const fs::path& to) {
  auto file = parse_json(text, JsonComments::allowed);
  if (!file) return std::string(text);
  const fs::path there = fs::weakly_canonical(to);
  cell_format().map_paths(*file, [&](const std::string& path) {
    return fs::weakly_canonical(resolved(path, from)).lexically_proximate(there).generic_string();
  });
  return file->dump(2) + "\n";
}

}  // namespace armloom

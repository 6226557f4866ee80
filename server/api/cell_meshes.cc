#include "server/api/cell_meshes.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/geometry/mesh/mesh.h"
#include "server/api/answers.h"
#include "server/http/open_file.h"
#include "server/http/served_bytes.h"
#include "server/messages/mesh_address.h"

namespace armloom {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kTypes{
    {{".stl", "model/stl"}, {".obj", "model/obj"}, {".dae", "model/vnd.collada+xml"}}};

constexpr const char* kGone = "the mesh file can no longer be read";
constexpr const char* kOtherType = "application/octet-stream";

Response not_found(const std::string& name, const std::string& why) {
  return problem_response(
      {Problem{ProblemKind::not_found, "no-such-mesh", "request target", why, name}});
}

}  // namespace

CellMeshes::CellMeshes(const Cell& cell) {
  const auto add = [&](const std::string& path) {
    std::error_code none;
    places_.emplace(mesh_name(path), Place{std::filesystem::canonical(path, none), "", {}, ""});
  };
  for (const Robot& robot : cell.robots) {
    for (const auto& [uri, path] : robot.mesh_files) add(path);
  }
  for (const CollisionObject& object : cell.objects) {
    if (const auto* mesh = std::get_if<Mesh>(&object.shape)) add(mesh->path);
  }
}

std::vector<std::string> CellMeshes::content_types() {
  std::vector<std::string> types;
  for (const auto& [extension, type] : kTypes) types.emplace_back(type);
  types.emplace_back(kOtherType);
  return types;
}

Response CellMeshes::answer(const Request& request, const std::string& name) {
  const auto known = places_.find(name);
  if (known == places_.end())
    return not_found(name, "the cell has no mesh \"" + name + "\": GET /cell names the meshes");
  Place& place = known->second;
  const auto file = OpenFile::open(place.file, kMaxMeshBytes);
  if (!file && file.error() == NoFile::busy) return refusal_response(too_many_files());
  if (!file || file->place() != place.file) return not_found(name, kGone);
  ServedBytes bytes{place.stamp == file->stamp() ? place.bytes.lock() : nullptr, nullptr,
                    place.tag};
  if (!bytes.plain) {
    auto read = file->read();
    if (!read) return not_found(name, kGone);
    bytes = served(std::move(*read), false);
    place.stamp = file->stamp();
    place.bytes = bytes.plain;
    place.tag = bytes.tag;
  }
  std::string type = kOtherType;
  for (const auto& [extension, known_type] : kTypes) {
    if (name.ends_with(extension)) type = known_type;
  }
  Response response = answer_bytes(request, bytes, std::move(type));
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}

}  // namespace armloom

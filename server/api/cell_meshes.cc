#include "server/api/cell_meshes.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "core/geometry/mesh/mesh.h"
#include "server/api/answers.h"
#include "server/messages/mesh_address.h"

namespace armloom {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kTypes{
    {{".stl", "model/stl"}, {".obj", "model/obj"}, {".dae", "model/vnd.collada+xml"}}};

constexpr const char* kOtherType = "application/octet-stream";

Response not_found(const std::string& name, const std::string& why) {
  return problem_response(
      {Problem{ProblemKind::not_found, "no-such-mesh", "request target", why, name}});
}

}  // namespace

CellMeshes::CellMeshes(const Cell& cell) {
  const auto add = [&](const std::string& path) { paths_.emplace(mesh_name(path), path); };
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

Response CellMeshes::answer(const std::string& name) const {
  const auto known = paths_.find(name);
  if (known == paths_.end()) return not_found(name, "the cell has no mesh \"" + name + "\"");
  std::error_code error;
  const auto size = std::filesystem::file_size(known->second, error);
  if (error || size > kMaxMeshBytes) return not_found(name, "the mesh can no longer be read");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(known->second, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) return not_found(name, "the mesh can no longer be read");
  Response response;
  response.content_type = kOtherType;
  for (const auto& [extension, type] : kTypes) {
    if (name.ends_with(extension)) response.content_type = type;
  }
  response.body = std::move(bytes);
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}

}  // namespace armloom

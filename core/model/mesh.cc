#include "core/model/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>

#include "core/model/convex_pieces.h"
#include "core/model/doubled_faces.h"
#include "core/model/findings.h"
#include "core/model/mesh_file.h"
#include "core/model/mesh_import.h"

namespace armloom {
namespace {

CheckedMesh<void> check_vertices(const MeshData& mesh) {
  if (mesh.triangles.empty())
    return refuse_mesh(ProblemKind::invalid, "mesh-empty", "it holds no triangle");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d& p = mesh.vertices[i];
    for (int axis = 0; axis < 3; ++axis) {
      const std::string place =
          "vertex " + std::to_string(i) + ": " + "xyz"[axis] + " is " + text_of(p[axis]);
      if (!std::isfinite(p[axis])) {
        return refuse_mesh(ProblemKind::invalid, "mesh-not-finite", place, text_of(p[axis]));
      }
      if (std::abs(p[axis]) > kMaxMeshReach_m) {
        return refuse_mesh(ProblemKind::too_large, "mesh-too-large",
                           place + " m, at most " + text_of(kMaxMeshReach_m) + " m are allowed",
                           p[axis]);
      }
    }
  }
  return {};
}

// A point is no body: nothing of it could be touched.
CheckedMesh<void> check_extent(const MeshData& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  if (box.diagonal().norm() > 0.0) return {};
  const Eigen::Vector3d& p = mesh.vertices.front();
  const std::string point = text_of(p.x()) + " " + text_of(p.y()) + " " + text_of(p.z());
  return refuse_mesh(ProblemKind::invalid, "mesh-without-extent",
                     "every corner of its " + std::to_string(mesh.triangles.size()) +
                         " triangles is the one point " + point,
                     point);
}

CheckedMesh<MeshPtr> load(const std::string& path, const Eigen::Vector3d& scale) {
  const auto format = mesh_format_of(path);
  if (!format) {
    return refuse_mesh(ProblemKind::unsupported, "mesh-format", "only .stl, .obj and .dae are read",
                       std::filesystem::path(path).extension().string());
  }
  const auto bytes = read_mesh_bytes(path, *format);
  if (!bytes) return tl::unexpected(bytes.error());
  auto mesh = import_mesh(*bytes, *format, scale);
  if (!mesh) return tl::unexpected(mesh.error());
  if (const auto sound = check_vertices(*mesh); !sound) return tl::unexpected(sound.error());
  if (const auto extent = check_extent(*mesh); !extent) return tl::unexpected(extent.error());
  auto hull = convex_hull(mesh->vertices);
  if (!hull)
    return refuse_mesh(ProblemKind::invalid, "mesh-hull", "it has no convex hull: " + hull.error());
  mesh->triangles = without_doubled_faces(std::move(mesh->triangles), mesh->vertices.size());
  mesh->hull = *std::move(hull);
  mesh->pieces = convex_pieces(*mesh);
  if (is_closed(mesh->triangles)) {
    mesh->surface = make_surface_tree(mesh->vertices, mesh->triangles);
  }
  return std::make_shared<const MeshData>(*std::move(mesh));
}

}  // namespace

bool is_flat(const MeshData& mesh) {
  const Eigen::Vector3d& first = mesh.vertices.front();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : mesh.vertices) {
    if ((p - first).norm() > along.norm()) along = p - first;
  }
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const Eigen::Vector3d across = along.cross(p - first);
    if (across.norm() > normal.norm()) normal = across;
  }
  if (normal.norm() <= kFlat_m * along.norm()) return true;  // a line
  normal.normalize();
  return std::ranges::all_of(mesh.vertices, [&](const Eigen::Vector3d& p) {
    return std::abs(normal.dot(p - first)) <= kFlat_m;
  });
}

bool is_mesh_name(const std::string& path) { return mesh_format_of(path).has_value(); }

Result<MeshPtr> load_mesh(const std::string& path, const Eigen::Vector3d& scale,
                          const std::string& pointer, const std::string& whose) {
  CheckedMesh<MeshPtr> mesh;
  try {
    mesh = load(path, scale);
  } catch (const std::exception& error) {  // assimp's own, for some broken files
    mesh = refuse_mesh(ProblemKind::malformed, "mesh-unreadable", error.what());
  }
  if (mesh) return *std::move(mesh);
  MeshRefusal& refusal = mesh.error();
  if (refusal.value.index() == 0) refusal.value = path;
  return failure(Problem{refusal.kind, std::move(refusal.slug), pointer,
                         whose + ": mesh " + path + ": " + refusal.why, std::move(refusal.value)});
}

Result<MeshPtr> MeshShelf::get(const std::string& path, const Eigen::Vector3d& scale,
                               const std::string& pointer, const std::string& whose) {
  const std::tuple key(path, scale.x(), scale.y(), scale.z());
  const auto known = meshes_.find(key);
  if (known != meshes_.end()) return known->second;
  auto mesh = load_mesh(path, scale, pointer, whose);
  if (mesh) meshes_.emplace(key, *mesh);
  return mesh;
}

}  // namespace armloom

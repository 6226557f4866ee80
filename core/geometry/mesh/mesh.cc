#include "core/geometry/mesh/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

#include "core/base/diagnostics.h"
#include "core/geometry/mesh/convex_pieces.h"
#include "core/geometry/mesh/mesh_import.h"
#include "core/geometry/mesh/obj_text.h"
#include "core/geometry/mesh/one_sided.h"
#include "core/geometry/mesh/sanitize_collada.h"
#include "core/geometry/mesh/stl_text.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

std::optional<MeshFormat> format_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".dae") return MeshFormat::dae;
  return std::nullopt;
}

Checked<std::string> read_bytes(const std::string& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    return refuse(ProblemKind::not_found, "file-missing", "there is no such file", path);
  }
  if (!fs::is_regular_file(status)) {
    return refuse(ProblemKind::invalid, "file-unreadable", "it is not a regular file", path);
  }
  const auto size = fs::file_size(path, error);
  if (error) return refuse(ProblemKind::invalid, "file-unreadable", "its size is unknown", path);
  if (size > kMaxMeshBytes) {
    return refuse(ProblemKind::too_large, "mesh-too-large",
                  "it has " + std::to_string(size) + " bytes, at most " +
                      std::to_string(kMaxMeshBytes) + " are read",
                  static_cast<double>(size));
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) return refuse(ProblemKind::invalid, "file-unreadable", "it cannot be read", path);
  if (bytes.empty()) return refuse(ProblemKind::invalid, "mesh-empty", "the file is empty", path);
  return bytes;
}

Checked<void> check_vertices(const MeshData& mesh) {
  if (mesh.triangles.empty())
    return refuse(ProblemKind::invalid, "mesh-empty", "it holds no triangle");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d& p = mesh.vertices[i];
    for (int axis = 0; axis < 3; ++axis) {
      const std::string place =
          "vertex " + std::to_string(i) + ": " + "xyz"[axis] + " is " + text_of(p[axis]);
      if (!std::isfinite(p[axis])) {
        return refuse(ProblemKind::invalid, "mesh-not-finite", place, text_of(p[axis]));
      }
      if (std::abs(p[axis]) > kMaxMeshReach_m) {
        return refuse(ProblemKind::too_large, "mesh-too-large",
                      place + " m, at most " + text_of(kMaxMeshReach_m) + " m are allowed",
                      p[axis]);
      }
    }
  }
  return {};
}

// Refuses a mesh that is a single point, because nothing could ever touch it.
Checked<void> check_extent(const MeshData& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  if (box.diagonal().norm() > 0.0) return {};
  const Eigen::Vector3d& p = mesh.vertices.front();
  const std::string point = text_of(p.x()) + " " + text_of(p.y()) + " " + text_of(p.z());
  return refuse(ProblemKind::invalid, "mesh-without-extent",
                "every corner of its " + std::to_string(mesh.triangles.size()) +
                    " triangles is the same point " + point,
                point);
}

// Input for assimp: the file's complete surface, and nothing else.
struct MeshText {
  std::string bytes;
  std::size_t triangles;  // upper bound for a DAE
};

Checked<MeshText> unchecked_size(std::string bytes, MeshFormat format) {
  const auto unreadable = [](const std::string& why) {
    return refuse(ProblemKind::malformed, "mesh-unreadable",
                  why + " (copy or export the file again)");
  };
  if (format == MeshFormat::dae) {
    auto essence = read_dae_essence(bytes);
    if (!essence) return unreadable(essence.error());
    return MeshText{std::move(essence->text), essence->triangles};
  }
  if (format == MeshFormat::obj) {
    auto obj = read_obj(bytes);
    if (!obj) return unreadable(obj.error());
    return MeshText{std::move(obj->text), obj->triangles};
  }
  auto stl = read_stl(std::move(bytes));
  if (!stl) return unreadable(stl.error());
  const std::size_t triangles = triangles_of_stl(*stl);
  return MeshText{*std::move(stl), triangles};
}

Checked<MeshText> checked_text(const std::string& path, MeshFormat format) {
  auto bytes = read_bytes(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto text = unchecked_size(*std::move(bytes), format);
  if (!text) return text;
  if (text->triangles == 0) {
    return refuse(ProblemKind::invalid, "mesh-empty", "it holds no triangle");
  }
  if (text->triangles <= kMaxMeshTriangles) return text;
  return refuse(ProblemKind::too_large, "mesh-too-large",
                "it has " + std::to_string(text->triangles) + " triangles, at most " +
                    std::to_string(kMaxMeshTriangles) + " are read",
                static_cast<double>(text->triangles));
}

Checked<MeshPtr> load(const std::string& path, const Eigen::Vector3d& scale) {
  const auto format = format_of(path);
  if (!format) {
    return refuse(ProblemKind::unsupported, "mesh-format", "only .stl, .obj and .dae are read",
                  fs::path(path).extension().string());
  }
  const auto text = checked_text(path, *format);
  if (!text) return tl::unexpected(text.error());
  auto mesh = import_mesh(text->bytes, *format, scale);
  if (!mesh) return tl::unexpected(mesh.error());
  if (*format != MeshFormat::dae && mesh->triangles.size() != text->triangles) {
    return refuse(ProblemKind::unsupported, "mesh-unreadable",
                  "its faces should give " + std::to_string(text->triangles) +
                      " triangles, but only " + std::to_string(mesh->triangles.size()) +
                      " could be made: export it as triangles",
                  static_cast<double>(mesh->triangles.size()));
  }
  if (const auto sound = check_vertices(*mesh); !sound) return tl::unexpected(sound.error());
  if (const auto extent = check_extent(*mesh); !extent) return tl::unexpected(extent.error());
  auto hull = convex_hull(mesh->vertices);
  if (!hull)
    return refuse(ProblemKind::invalid, "mesh-hull",
                  "its convex hull cannot be computed: " + hull.error());
  mesh->hull = *std::move(hull);
  auto sides = one_sided(mesh->triangles);
  mesh->both_sides = !sides;
  if (sides) mesh->triangles = *std::move(sides);
  mesh->open_edges = open_edges(mesh->triangles);
  mesh->pieces = convex_pieces(*mesh);
  if (mesh->open_edges == 0 && !mesh->both_sides) {
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

bool is_mesh_name(const std::string& path) { return format_of(path).has_value(); }

Result<MeshPtr> load_mesh(const std::string& path, const Eigen::Vector3d& scale,
                          const std::string& pointer, const std::string& whose) {
  Checked<MeshPtr> mesh;
  try {
    mesh = load(path, scale);
  } catch (const std::exception& error) {  // thrown by assimp for some broken files
    mesh = refuse(ProblemKind::malformed, "mesh-unreadable", error.what());
  }
  if (mesh) return *std::move(mesh);
  MeshRefusal& refusal = mesh.error();
  if (refusal.value.index() == 0) refusal.value = path;
  return failure(Problem{refusal.kind, std::move(refusal.slug), pointer,
                         whose + ": mesh " + path + ": " + refusal.why, std::move(refusal.value)});
}

Result<MeshPtr> MeshCache::get(const std::string& path, const Eigen::Vector3d& scale,
                               const std::string& pointer, const std::string& whose) {
  const std::tuple key(path, scale.x(), scale.y(), scale.z());
  const auto known = meshes_.find(key);
  if (known != meshes_.end()) return known->second;
  auto mesh = load_mesh(path, scale, pointer, whose);
  if (mesh) meshes_.emplace(key, *mesh);
  return mesh;
}

}  // namespace armloom

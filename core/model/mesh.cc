#include "core/model/mesh.h"

#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <system_error>

#include "core/model/convex_pieces.h"
#include "core/model/dae_essence.h"
#include "core/model/findings.h"
#include "core/model/obj_text.h"
#include "core/model/one_sided.h"
#include "core/model/stl_text.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

// A reason for refusing, without the place.
struct Refusal {
  ProblemKind kind;
  std::string slug;
  std::string why;
  decltype(Problem::value) value = {};
};
template <class T>
using Checked = tl::expected<T, Refusal>;

tl::unexpected<Refusal> refuse(ProblemKind kind, std::string slug, std::string why,
                               decltype(Problem::value) value = {}) {
  return tl::unexpected(Refusal{kind, std::move(slug), std::move(why), std::move(value)});
}

enum class MeshFormat { stl, obj, dae };

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

// The bytes in memory as assimp's only file.
class OneStream final : public Assimp::IOStream {
 public:
  explicit OneStream(const std::string& bytes) : bytes_(bytes) {}
  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - place_) / size);
    std::memcpy(buffer, bytes_.data() + place_, whole * size);
    place_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET   ? 0
                             : origin == aiOrigin_CUR ? place_
                                                      : bytes_.size();
    if (offset > bytes_.size() - from) return aiReturn_FAILURE;
    place_ = from + offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return place_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  const std::string& bytes_;
  std::size_t place_ = 0;
};

class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(std::string name, const std::string& bytes) : name_(std::move(name)), bytes_(bytes) {}
  bool Exists(const char* file) const override { return name_ == file; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char*) override {
    return name_ == file ? new OneStream(bytes_) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  std::string name_;
  const std::string& bytes_;
};

// Collects the triangles of all nodes, equal points once.
class Collector {
 public:
  explicit Collector(const Eigen::Vector3d& scale) : scale_(scale) {}

  // False: over the bound.
  bool add(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_FP) {
    const aiMatrix4x4 X_FN = X_FP * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
      if (!add(*scene.mMeshes[node.mMeshes[m]], X_FN)) return false;
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) {
      if (!add(scene, *node.mChildren[c], X_FN)) return false;
    }
    return true;
  }

  MeshData mesh;

 private:
  bool add(const aiMesh& part, const aiMatrix4x4& X_FN) {
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines have no surface
      if (mesh.triangles.size() >= kMaxMeshTriangles) return false;
      Triangle triangle{};
      for (std::size_t i = 0; i < 3; ++i)
        triangle[i] = vertex(part.mVertices[face.mIndices[i]], X_FN);
      mesh.triangles.push_back(triangle);
    }
    return true;
  }

  std::uint32_t vertex(const aiVector3D& p_N, const aiMatrix4x4& X_FN) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const Eigen::Vector3d as_written(p_N.x, p_N.y, p_N.z);
    const aiVector3D p = X_FN * p_N;
    const Eigen::Vector3d p_S = scale_.cwiseProduct(Eigen::Vector3d(p.x, p.y, p.z));
    // NaN is unordered and may not be a key; the caller reports it, as the file has it.
    if (!p_S.allFinite()) {
      mesh.vertices.push_back(as_written.allFinite() ? p_S : as_written);
      return next;
    }
    const auto [it, is_new] = known_.try_emplace({p_S.x(), p_S.y(), p_S.z()}, next);
    if (is_new) mesh.vertices.push_back(p_S);
    return it->second;
  }

  Eigen::Vector3d scale_;
  std::map<std::tuple<double, double, double>, std::uint32_t> known_;
};

// Only the importer for the file's own kind: assimp else also looks at the content.
void keep_only(Assimp::Importer& importer, const char* extension) {
  std::set<Assimp::BaseImporter*> others;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i)
    others.insert(importer.GetImporter(i));
  others.erase(importer.GetImporter(extension));
  for (Assimp::BaseImporter* other : others) {
    importer.UnregisterLoader(other);
    delete other;  // assimp forgets it without freeing it
  }
}

Checked<MeshData> import(const std::string& bytes, MeshFormat format,
                         const Eigen::Vector3d& scale) {
  static constexpr const char* kExtensions[] = {"stl", "obj", "dae"};
  const char* extension = kExtensions[static_cast<std::size_t>(format)];
  const std::string name = std::string("mesh.") + extension;
  Assimp::Importer importer;
  keep_only(importer, extension);
  importer.SetIOHandler(new OneFile(name, bytes));  // owned by the importer
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(name, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = importer.GetErrorString();
    return refuse(
        ProblemKind::malformed, "mesh-unreadable",
        "it cannot be read as " + std::string(extension) + (reason.empty() ? "" : ": " + reason));
  }
  Collector collector(scale);
  if (!collector.add(*scene, *scene->mRootNode, aiMatrix4x4())) {
    return refuse(ProblemKind::too_large, "mesh-too-large",
                  "it has more than " + std::to_string(kMaxMeshTriangles) + " triangles");
  }
  return std::move(collector.mesh);
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

// A point is no body: nothing of it could be touched.
Checked<void> check_extent(const MeshData& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  if (box.diagonal().norm() > 0.0) return {};
  const Eigen::Vector3d& p = mesh.vertices.front();
  const std::string point = text_of(p.x()) + " " + text_of(p.y()) + " " + text_of(p.z());
  return refuse(ProblemKind::invalid, "mesh-without-extent",
                "every corner of its " + std::to_string(mesh.triangles.size()) +
                    " triangles is the one point " + point,
                point);
}

// What assimp may read: all that the file says of its surface, and nothing else.
struct MeshText {
  std::string bytes;
  std::size_t triangles;  // of a DAE: at most
};

Checked<MeshText> unchecked_size(std::string bytes, MeshFormat format) {
  const auto unreadable = [](const std::string& why) {
    return refuse(ProblemKind::malformed, "mesh-unreadable",
                  why + " (copy the file, or export it, again)");
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
  auto mesh = import(text->bytes, *format, scale);
  if (!mesh) return tl::unexpected(mesh.error());
  if (*format != MeshFormat::dae && mesh->triangles.size() != text->triangles) {
    return refuse(ProblemKind::unsupported, "mesh-unreadable",
                  "its faces are " + std::to_string(text->triangles) + " triangles, but only " +
                      std::to_string(mesh->triangles.size()) +
                      " could be made of them: export it as triangles",
                  static_cast<double>(mesh->triangles.size()));
  }
  if (const auto sound = check_vertices(*mesh); !sound) return tl::unexpected(sound.error());
  if (const auto extent = check_extent(*mesh); !extent) return tl::unexpected(extent.error());
  auto hull = convex_hull(mesh->vertices);
  if (!hull)
    return refuse(ProblemKind::invalid, "mesh-hull", "it has no convex hull: " + hull.error());
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
  } catch (const std::exception& error) {  // assimp's own, for some broken files
    mesh = refuse(ProblemKind::malformed, "mesh-unreadable", error.what());
  }
  if (mesh) return *std::move(mesh);
  Refusal& refusal = mesh.error();
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

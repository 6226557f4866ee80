#include "core/geometry/mesh/mesh_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

namespace armloom {
namespace {

// Presents bytes in memory as assimp's only file.
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

// Collects the triangles of all nodes and merges equal points.
class Collector {
 public:
  explicit Collector(const Eigen::Vector3d& scale) : scale_(scale) {}

  // Returns false if there are too many triangles.
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
    // A point with NaN cannot be a key, because NaN is unordered. The caller reports the point as
    // written in the file.
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

// Keeps only the importer for the file's format. Otherwise assimp would also guess the format from
// the content.
void keep_only(Assimp::Importer& importer, const char* extension) {
  std::set<Assimp::BaseImporter*> others;
  for (std::size_t i = 0; i < importer.GetImporterCount(); ++i)
    others.insert(importer.GetImporter(i));
  others.erase(importer.GetImporter(extension));
  for (Assimp::BaseImporter* other : others) {
    importer.UnregisterLoader(other);
    delete other;  // assimp does not free it
  }
}

}  // namespace

Checked<MeshData> import_mesh(const std::string& bytes, MeshFormat format,
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

}  // namespace armloom

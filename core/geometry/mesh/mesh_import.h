#pragma once

#include <Eigen/Core>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "core/base/problem.h"
#include "core/geometry/mesh/mesh.h"

namespace armloom {

// The reason why a mesh is refused. The caller adds the mesh's name.
struct MeshRefusal {
  ProblemKind kind;
  std::string slug;
  std::string why;
  decltype(Problem::value) value = {};
};
template <class T>
using Checked = tl::expected<T, MeshRefusal>;

[[nodiscard]] inline tl::unexpected<MeshRefusal> refuse(ProblemKind kind, std::string slug,
                                                        std::string why,
                                                        decltype(Problem::value) value = {}) {
  return tl::unexpected(MeshRefusal{kind, std::move(slug), std::move(why), std::move(value)});
}

enum class MeshFormat { stl, obj, dae };

// Reads the triangles of all nodes with assimp, which is used only here. Points are in the shape's
// frame; equal points are merged. Refuses files that assimp cannot read, and more than
// kMaxMeshTriangles. May throw for some broken files.
[[nodiscard]] Checked<MeshData> import_mesh(const std::string& bytes, MeshFormat format,
                                            const Eigen::Vector3d& scale);

}  // namespace armloom

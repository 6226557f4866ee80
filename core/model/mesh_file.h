#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "core/base/problem.h"

namespace armloom {

// A reason for refusing a mesh, without the place.
struct MeshRefusal {
  ProblemKind kind;
  std::string slug;
  std::string why;
  decltype(Problem::value) value = {};
};
template <class T>
using CheckedMesh = tl::expected<T, MeshRefusal>;

[[nodiscard]] inline tl::unexpected<MeshRefusal> refuse_mesh(ProblemKind kind, std::string slug,
                                                             std::string why,
                                                             decltype(Problem::value) value = {}) {
  return tl::unexpected(MeshRefusal{kind, std::move(slug), std::move(why), std::move(value)});
}

enum class MeshFormat { stl, obj, dae };

// By the extension, in any case.
[[nodiscard]] std::optional<MeshFormat> mesh_format_of(const std::string& path);

// The file's bytes as assimp may read them: whole, of bounded size and number of triangles
// (mesh.h), a DAE cut down to its geometry.
[[nodiscard]] CheckedMesh<std::string> read_mesh_bytes(const std::string& path, MeshFormat format);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <string>

#include "core/model/mesh.h"
#include "core/model/mesh_file.h"

namespace armloom {

// The vertices and triangles of a mesh file's bytes (mesh_file.h), as mesh.h has them, read by
// assimp; hull, pieces and surface stay empty.
[[nodiscard]] CheckedMesh<MeshData> import_mesh(const std::string& bytes, MeshFormat format,
                                                const Eigen::Vector3d& scale);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/problem.h"
#include "core/geometry/mesh/convex_hull.h"
#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// The surface of a mesh file in the shape's frame S (m). Units, node transforms and the URDF scale
// are applied; the file's "up axis" is ignored, as in RViz. The orientation of triangles has no
// meaning, because a negative scale reverses it. Points that are equal in float precision are a
// single vertex. Solids that are modeled from both sides have each face once (one_sided.h).
struct MeshData {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;  // indices into vertices; at least one
  ConvexHull hull;                  // contains all vertices (convex_hull.h)
  // Their union contains the solid (convex_pieces.h); use `hull` if there are no pieces.
  std::vector<ConvexHull> pieces;
  // The triangles, if they are closed. Null if it is unknown what they enclose. Then the pieces are
  // used as the solid (if the surface is open, its hull).
  SurfaceTreePtr surface;
  std::size_t open_edges = 0;  // number of open edges (surface_tree.h); zero if closed
  bool both_sides = false;     // one_sided() could not decide which faces to keep
};
using MeshPtr = std::shared_ptr<const MeshData>;

inline constexpr std::size_t kMaxMeshBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxMeshTriangles = 500'000;
inline constexpr double kMaxMeshReach_m = 1000.0;  // bound of each coordinate

// Reads an STL (text or binary), OBJ or DAE file. Never opens other files that the mesh file names
// (materials, textures). Returns a Problem with `pointer`, and with a sentence that starts with
// `whose` (for example "robot left"), if the file
// - is missing, not regular, unreadable, empty or of another kind,
// - exceeds a bound above (checked before much memory is used),
// - has no triangle, is a single point, or has a number that is not finite, or
// - has surface content that cannot be read and would be lost.
// Precondition: the components of scale are finite and not zero.
[[nodiscard]] Result<MeshPtr> load_mesh(const std::string& path, const Eigen::Vector3d& scale,
                                        const std::string& pointer, const std::string& whose);

// Loads each file once per scale.
class MeshCache {
 public:
  [[nodiscard]] Result<MeshPtr> get(const std::string& path, const Eigen::Vector3d& scale,
                                    const std::string& pointer, const std::string& whose);

 private:
  std::map<std::tuple<std::string, double, double, double>, MeshPtr> meshes_;
};

// Returns true if all vertices lie within kFlat_m of a plane. Such a mesh is probably a mistake.
[[nodiscard]] bool is_flat(const MeshData& mesh);

// Returns true if the path ends with .stl, .obj or .dae, in upper or lower case.
[[nodiscard]] bool is_mesh_name(const std::string& path);

}  // namespace armloom

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

// The surface of a mesh as its file has it: in the shape's frame S, metres, with the file's own
// units, the transforms of its nodes and the scale of the URDF applied. A file's "up axis" is not:
// robots' meshes are z up whatever they say (as in RViz). Orientation says nothing: a negative
// scale mirrors. Equal points are one vertex; numbers have the precision of a float. A solid whose
// every face is there twice, as seen from both sides, has it once (one_sided.h).
struct MeshData {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;  // indices into vertices; at least one
  ConvexHull hull;                  // contains all vertices (convex_hull.h)
  std::vector<ConvexHull> pieces;   // contain the solid together (convex_pieces.h); none: the hull
  // The same triangles, where they close: what the pieces stand for. Null: nobody can say what the
  // surface encloses, and the pieces are taken for the solid (of an open surface its hull).
  SurfaceTreePtr surface;
  std::size_t open_edges = 0;  // of the triangles (surface_tree.h); none: they close
  bool both_sides = false;     // one_sided() could not say
};
using MeshPtr = std::shared_ptr<const MeshData>;

inline constexpr std::size_t kMaxMeshBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxMeshTriangles = 500'000;
inline constexpr double kMaxMeshReach_m = 1000.0;  // of any coordinate

// Reads an STL (text or binary), OBJ or DAE file. Opens this file and no other, whatever it names
// (materials, textures). A Problem, with pointer and the sentence's beginning ("robot left") as
// given, when the file is missing, not regular, unreadable, empty, of another kind, over one of the
// bounds above (told before much memory is used), without a triangle, one single point, holds a
// number that is not finite, or anything else that it says of its surface would be left out.
// Precondition: scale is finite and holds no 0.
[[nodiscard]] Result<MeshPtr> load_mesh(const std::string& path, const Eigen::Vector3d& scale,
                                        const std::string& pointer, const std::string& whose);

// Loads each file once for each scale: robots of one kind share their meshes.
class MeshCache {
 public:
  [[nodiscard]] Result<MeshPtr> get(const std::string& path, const Eigen::Vector3d& scale,
                                    const std::string& pointer, const std::string& whose);

 private:
  std::map<std::tuple<std::string, double, double, double>, MeshPtr> meshes_;
};

// Whether all vertices lie within kFlat_m of a plane: sound, but a body with no inside is rarely
// meant.
[[nodiscard]] bool is_flat(const MeshData& mesh);

// Whether load_mesh reads files with such a name: .stl, .obj, .dae, in any case.
[[nodiscard]] bool is_mesh_name(const std::string& path);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom {

inline constexpr std::size_t kMaxPieces = 8;
// A cut must take away this part of the whole hull's volume. So a bore or a shallow dent is none.
inline constexpr double kCutGain = 0.05;
// Larger meshes are not cut: it would take seconds.
inline constexpr std::size_t kMaxTrianglesCut = 20'000;

// Convex polytopes whose union contains the mesh: its surface S and every point that S encloses.
// At least one; just {mesh.hull} when no single cut across an axis of the mesh's frame helps, when
// the surface encloses nearly as much by its orientation, the mesh is not closed (an edge that
// borders an odd number of triangles) or is too large.
//
// Why the union holds: the cuts part space into boxes, some sides at infinity. Let K be what lies
// of the mesh in one of them. An extreme point of K's hull lies in K. If on S, in a triangle, then
// it is a corner of this triangle clipped by the box; if enclosed by S, a neighbourhood of it is,
// so that it is a corner of the box. The hull is that of all corners of clipped triangles, and of
// those corners of the box that cannot be shown to be outside: of which no ray leaves without
// hitting S. Orientation of the triangles, or parts that overlap, do not matter. Rounding is below
// kHullTolerance_m, as for the hull (convex_hull.h).
//
// A ring is not cut: no single cut of it gains anything.
[[nodiscard]] std::vector<ConvexHull> convex_pieces(const MeshData& mesh);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom {

inline constexpr std::size_t kMaxPieces = 8;
// Share of the whole hull's volume that a cut must remove. Bores and shallow dents are not cut.
inline constexpr double kCutGain = 0.05;
// Larger meshes are not cut, because that would take seconds.
inline constexpr std::size_t kMaxTrianglesCut = 20'000;

// Returns convex polytopes whose union contains the mesh: its surface S and every point that S
// encloses. Returns just {mesh.hull} if
// - no single cut across an axis of the mesh's frame helps (for example for a ring),
// - the volume that the surface encloses (computed from the triangles' orientation) is nearly that
//   of its hull,
// - an edge borders an odd number of triangles (not closed), or
// - the mesh is too large.
//
// Proof. The cuts divide space into boxes, some with sides at infinity. Let K be the part of the
// mesh in one box. An extreme point e of K's hull lies in K. If e is on S, e is a corner of a
// triangle clipped by the box. If S encloses e, S also encloses all points near e, so e is a corner
// of the box. The piece is the hull of all corners of clipped triangles and of all corners of the
// box from which every ray tried hits S. Orientation and overlap of triangles do not matter.
// Rounding is below kHullTolerance_m.
[[nodiscard]] std::vector<ConvexHull> convex_pieces(const MeshData& mesh);

}  // namespace armloom

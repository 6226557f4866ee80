#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom::soundness {

// A closed concave mesh of blocks, about `size_m` large, around the origin: an L, a U, a C, a ring,
// a frame, a box with a slot, a closed hollow box or random blocks. Corners are moved by up to
// `noise` of a block. Has pieces and surface, like a loaded mesh.
struct MeshWish {
  double size_m = 0.3;
  double noise = 0.0;   // 0 to 0.25
  bool crumbs = false;  // adds a small separate box
};
[[nodiscard]] MeshPtr concave_mesh(const MeshWish& wish, std::mt19937_64& random);

// Returns a prism over a curve that goes twice around the z-axis. Its surface winds twice around
// each point within 0.12 m of the axis and, along the axis, within 0.2 m of the origin. The mesh
// has a surface but no pieces.
[[nodiscard]] MeshPtr twice_wound_mesh();

// Flips some triangles, so that orientation no longer tells outside from inside.
[[nodiscard]] MeshPtr turned_over(const MeshData& mesh, std::mt19937_64& random);

// Returns for each vertex the smallest vertex of its connected component.
[[nodiscard]] std::vector<std::uint32_t> components_of(const MeshData& mesh);

// Returns true if a connected component winds around the point, computed from solid angles.
// Precondition: consistently oriented triangles.
[[nodiscard]] bool winds_about(const MeshData& mesh, const std::vector<std::uint32_t>& components,
                               const Eigen::Vector3d& p);

[[nodiscard]] double between(std::mt19937_64& random, double from, double to);

}  // namespace armloom::soundness

#pragma once

#include <memory>
#include <random>

#include "core/model/mesh.h"

namespace armloom::soundness {

// A closed concave mesh of blocks in a grid whose planes lie at random distances: an L, a U, a C, a
// ring, a frame, a box with a slot, a hollow box (a room with no door) or blocks at random, corners
// moved at random by up to `noise` of a block. About `size_m` large, about the origin. With pieces
// and surface as a mesh that was read from a file has them.
struct MeshWish {
  double size_m = 0.3;
  double noise = 0.0;     // 0 to 0.25
  bool one_mind = true;   // false: some triangles are turned over
  bool crumbs = false;    // and a small loose box beside it
};
[[nodiscard]] MeshPtr concave_mesh(const MeshWish& wish, std::mt19937_64& random);

// How often the surface's components wind about the point, the largest of them, by solid angles: no
// rays, no tree. Right where triangles are of one mind.
[[nodiscard]] int winding_about(const MeshData& mesh, const Eigen::Vector3d& p);

}  // namespace armloom::soundness

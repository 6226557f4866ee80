#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom::soundness {

// A closed concave mesh of blocks in a grid whose planes lie at random distances: an L, a U, a C, a
// ring, a frame, a box with a slot, a hollow box (a room with no door) or blocks at random, corners
// moved at random by up to `noise` of a block. About `size_m` large, about the origin. With pieces
// and surface as a mesh that was read from a file has them.
struct MeshWish {
  double size_m = 0.3;
  double noise = 0.0;   // 0 to 0.25
  bool crumbs = false;  // and a small loose box beside it
};
[[nodiscard]] MeshPtr concave_mesh(const MeshWish& wish, std::mt19937_64& random);

// A prism over a curve that goes twice about the z-axis (and so meets itself): inside of its
// smaller turn, up to 0.12 m from the axis and 0.2 m from the origin along it, the surface winds
// twice about each point. With a surface only.
[[nodiscard]] MeshPtr twice_wound_mesh();

// The mesh with some triangles turned over: where outside is cannot be told by them any more.
[[nodiscard]] MeshPtr turned_over(const MeshData& mesh, std::mt19937_64& random);

// For each corner the smallest one that it hangs together with.
[[nodiscard]] std::vector<std::uint32_t> components_of(const MeshData& mesh);

// Whether one of the components winds about the point, by solid angles: no rays, no tree.
// Precondition: the triangles are of one mind about outside.
[[nodiscard]] bool winds_about(const MeshData& mesh, const std::vector<std::uint32_t>& components,
                               const Eigen::Vector3d& p);

// Uniform in [from, to).
[[nodiscard]] double between(std::mt19937_64& random, double from, double to);

}  // namespace armloom::soundness

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace armloom {

using Triangle = std::array<std::uint32_t, 3>;

// How many edges border an odd number of triangles. None: the surface has no rim, it closes.
[[nodiscard]] std::size_t open_edges(const std::vector<Triangle>& triangles);
[[nodiscard]] bool is_closed(const std::vector<Triangle>& triangles);

// The triangles of a surface in a tree of boxes, for distances that ask few of them. Everything is
// in the frame T of the vertices, in metres. Some 100 bytes a triangle, more where they are long.
// Immutable.
struct SurfaceTree {
  // A box along the axes of T around all triangles below it, or shares of them.
  struct Box {
    Eigen::Vector3f center;
    Eigen::Vector3f half;  // rounded up, so that the box holds its triangles
    std::uint32_t below;   // of a leaf its triangle, else a node
    bool leaf;
  };
  // Up to four boxes, coordinate by coordinate: four are looked at in one step.
  struct Node {
    std::array<Eigen::Array4f, 3> center;
    std::array<Eigen::Array4f, 3> half;  // of a box that is not there: far below zero
    std::array<std::uint32_t, 4> below;
    std::array<bool, 4> leaf;

    [[nodiscard]] Box box(std::size_t i) const {
      const auto k = static_cast<Eigen::Index>(i);
      return {{center[0][k], center[1][k], center[2][k]},
              {half[0][k], half[1][k], half[2][k]},
              below[i],
              leaf[i]};
    }
  };
  // Triangles that hang together by common corners. Of a closed surface each component is closed.
  struct Component {
    std::uint32_t vertex;  // one of its corners
    // Each edge is passed as often one way as the other: the triangles are of one mind about where
    // outside is (either side), so that a winding number is defined.
    bool oriented;
  };

  Box root;  // around everything
  std::vector<Node> nodes;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> component_of;  // by triangle
  std::vector<Component> components;
  double reach_m = 0.0;   // of the farthest vertex from the origin of T
  bool encloses = false;  // is_closed(), and enough triangles to hold a volume

  [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::uint32_t triangle) const {
    const Triangle& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
};
using SurfaceTreePtr = std::shared_ptr<const SurfaceTree>;

// Long triangles are shared out among several leaves first, each with a box around its share.
// Halved at the median along the longest side, and again, until a leaf is one share. Degenerate
// triangles (a point, a segment) are as good as others. Deterministic; half a second for half a
// million triangles. Precondition: at least one triangle, all numbers finite.
[[nodiscard]] SurfaceTreePtr make_surface_tree(std::vector<Eigen::Vector3d> vertices,
                                               std::vector<Triangle> triangles);

}  // namespace armloom

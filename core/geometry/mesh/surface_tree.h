#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace armloom {

using Triangle = std::array<std::uint32_t, 3>;

// Returns the number of edges that border an odd number of triangles; zero if closed.
[[nodiscard]] std::size_t open_edges(const std::vector<Triangle>& triangles);
[[nodiscard]] bool is_closed(const std::vector<Triangle>& triangles);

// Triangles in a tree of boxes, so that distance queries visit only few triangles. All members are
// in the frame T of the vertices (m). Takes about 100 bytes per triangle, more for long triangles.
// Immutable.
struct SurfaceTree {
  // A box along the axes of T around all triangles, or parts of triangles, below it.
  struct Box {
    Eigen::Vector3f center;
    Eigen::Vector3f half;  // rounded up, so that the box contains its triangles
    std::uint32_t below;   // leaf: index of its triangle; else index of a node
    bool leaf;
  };
  // Up to four boxes, stored by coordinate so that four are tested in one step.
  struct Node {
    std::array<Eigen::Array4f, 3> center;
    std::array<Eigen::Array4f, 3> half;  // far below zero for an unused box
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
  // Triangles connected by common corners. In a closed surface each component is closed.
  struct Component {
    std::uint32_t vertex;  // one of its vertices
    // Each edge is used equally often in both directions, so that a winding number is defined.
    bool oriented;
  };

  Box root;  // around all triangles
  std::vector<Node> nodes;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> component_of;  // by triangle
  std::vector<Component> components;
  double reach_m = 0.0;   // farthest vertex from the origin of T
  bool encloses = false;  // is closed and has at least four triangles

  [[nodiscard]] std::array<Eigen::Vector3d, 3> corners(std::uint32_t triangle) const {
    const Triangle& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
};
using SurfaceTreePtr = std::shared_ptr<const SurfaceTree>;

// Builds the tree. Divides long triangles into parts, each with a box. Halves the list of parts at
// the median along the longest side until each leaf has a single part. Accepts degenerate triangles
// (points, segments). Deterministic; half a second for half a million triangles. Precondition: at
// least one triangle, all numbers finite.
// `are_divided`: false for faces along the axes of T. Two such triangles fill their box, so that
// parts would gain nothing.
[[nodiscard]] SurfaceTreePtr make_surface_tree(std::vector<Eigen::Vector3d> vertices,
                                               std::vector<Triangle> triangles,
                                               bool are_divided = true);

}  // namespace armloom

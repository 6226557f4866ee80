#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom {

// The audit's model of a mesh: triangles, relative to the center C of their bounding box.
class AuditedMesh {
 public:
  explicit AuditedMesh(const MeshData& mesh);

  [[nodiscard]] const Eigen::Vector3d& p_SC() const { return p_SC_; }  // C in the shape's frame
  [[nodiscard]] double radius_m() const { return radius_m_; }          // about C
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> make_surface() const;

  // Returns one vertex of each connected piece, at most kMaxRepresentatives (largest pieces first).
  // A piece that does not touch another surface is inside this surface if its vertex is.
  static constexpr std::size_t kMaxRepresentatives = 64;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& representatives() const {
    return representatives_;
  }

  // Returns true if rays from the point cross a piece of the surface an odd number of times (for
  // the majority of three rays, because a ray may graze an edge). Orientation is ignored. For a
  // point on the surface, and for surfaces with holes, either result is possible.
  [[nodiscard]] bool encloses(const Eigen::Vector3d& p_C) const;

 private:
  struct Piece {
    Eigen::AlignedBox3d box;
    std::vector<Triangle> triangles;
  };
  [[nodiscard]] bool crosses_odd(const Piece& piece, const Eigen::Vector3d& p,
                                 const Eigen::Vector3d& ray) const;

  Eigen::Vector3d p_SC_;
  double radius_m_ = 0.0;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Piece> pieces_;
  std::vector<Eigen::Vector3d> representatives_;
};

}  // namespace armloom

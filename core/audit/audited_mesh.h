#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/geometry/mesh/mesh.h"

namespace armloom {

// A mesh as the audit sees it: its plain triangles, about the middle C of their bounding box, which
// is the origin of all points here.
class AuditedMesh {
 public:
  explicit AuditedMesh(const MeshData& mesh);

  [[nodiscard]] const Eigen::Vector3d& p_SC() const { return p_SC_; }  // C in the shape's frame
  [[nodiscard]] double radius_m() const { return radius_m_; }          // about C
  [[nodiscard]] std::shared_ptr<fcl::CollisionGeometryd> make_surface() const;

  // One vertex of each connected piece of the surface: a piece that touches nothing is inside of
  // another surface if this vertex is. Of the kMaxRepresentatives largest pieces, should a file be
  // a heap of crumbs.
  static constexpr std::size_t kMaxRepresentatives = 64;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& representatives() const {
    return representatives_;
  }

  // Whether the surface closes around the point: whether rays from it cross one of its pieces an
  // odd number of times (the majority of three rays, as one may graze an edge). Orientation plays
  // no part. Points on the surface may be either; surfaces with holes do not close around anything.
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

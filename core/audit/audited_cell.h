#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/audit/audited_mesh.h"
#include "core/audit/audited_primitive.h"
#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/model/kinematics.h"

namespace armloom {

// A link or object: one FCL object per collision element.
struct AuditedSolid {
  struct Element {
    fcl::CollisionObjectd surface;  // triangles
    Eigen::Isometry3d X_LS;  // pose in the link's frame (mesh: of the center of its bounding box)
    double radius_m;         // bounding sphere
    double round_m;          // subtracted from distances to the surface
    // Exactly one is set.
    std::shared_ptr<const AuditedMesh> mesh;
    std::shared_ptr<const AuditedPrimitive> primitive;
  };
  std::string name;
  std::optional<LinkId> link;  // nullopt if an object
  std::optional<ArmId> arm;    // nullopt if stationary
  std::vector<Element> elements;
  double radius_m = 0.0;  // bounding sphere about the link's origin
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
  double travel_m = 0.0;         // upper bound of the path length of each of its points so far
  bool elements_placed = false;  // the FCL objects are placed at X_WL
};

struct AuditedPair {
  std::size_t a;
  std::size_t b;
  bool contact_only;  // within one arm (Cell::is_own)
  // Lower bound of the distance, and both solids' travel, at the last look().
  double distance_then_m;
  double travel_then_m;
};

// The audit's model of the cell: poses, and every pair that must not touch.
class AuditedCell {
 public:
  // Fails if a mesh has no data.
  [[nodiscard]] static Result<AuditedCell> build(const Cell& cell);

  // Moves all links to q and adds to each solid's travel.
  void move_to(const Cell& cell, const Configuration& q);

  [[nodiscard]] std::vector<AuditedPair>& pairs() { return pairs_; }
  [[nodiscard]] const AuditedSolid& solid(std::size_t index) const { return solids_[index]; }

  // Returns a lower bound of the distance, from the last look() and the travel since.
  [[nodiscard]] double at_least(const AuditedPair& pair) const;
  // Computes the distance with FCL and stores it for at_least(). If the distance is below
  // `matters_m`, the result is exact (to 0.03 mm; 0.1 mm for cylinders of 1 m radius). Otherwise
  // the result is at least `matters_m`. Zero in contact, if one solid is inside the other, or if
  // FCL throws.
  [[nodiscard]] double look(AuditedPair& pair, double matters_m);

 private:
  void add(AuditedSolid solid, const std::vector<PlacedShape>& shapes);
  static AuditedSolid::Element make_element(const PlacedShape& placed);
  void place_elements(AuditedSolid& solid) const;

  std::vector<AuditedSolid> solids_;
  std::vector<AuditedPair> pairs_;
  LinkPoses X_WL_;
  bool moved_once_ = false;
};

}  // namespace armloom

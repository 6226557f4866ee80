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

// A link with shapes, or an object, as one FCL object for each collision element.
struct AuditedSolid {
  struct Element {
    fcl::CollisionObjectd surface;  // triangles
    Eigen::Isometry3d X_LS;         // of a mesh: to the middle of its bounding box
    double radius_m;                // of its bounding sphere
    double round_m;                 // everything is so much nearer than from the surface
    // One of the two.
    std::shared_ptr<const AuditedMesh> mesh;
    std::shared_ptr<const AuditedPrimitive> primitive;
  };
  std::string name;
  std::optional<LinkId> link;  // none: an object
  std::optional<ArmId> arm;    // none: it stands still
  std::vector<Element> elements;
  double radius_m = 0.0;  // about the origin of the link, all elements within
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
  double travel_m = 0.0;         // no point of it has moved farther than this since the beginning
  bool elements_placed = false;  // the FCL objects stand at X_WL
};

struct AuditedPair {
  std::size_t a;
  std::size_t b;
  bool contact_only;  // one arm's own (Cell::is_own)
  // What the distance was known to be, at least, and how far both had travelled then.
  double distance_then_m;
  double travel_then_m;
};

// The cell as the audit sees it: every pair that is not allowed to touch, and where things are.
class AuditedCell {
 public:
  // Problems: meshes without data.
  [[nodiscard]] static Result<AuditedCell> build(const Cell& cell);

  // Moves everything to q and adds to each solid's travel.
  void move_to(const Cell& cell, const Configuration& q);

  [[nodiscard]] std::vector<AuditedPair>& pairs() { return pairs_; }
  [[nodiscard]] const AuditedSolid& solid(std::size_t index) const { return solids_[index]; }

  // What the pair's distance cannot be below, from what was seen before and the travel since.
  [[nodiscard]] double at_least(const AuditedPair& pair) const;
  // Asks FCL and remembers: the distance when it is below `matters_m` (to 0.03 mm, of cylinders of
  // 1 m radius 0.1 mm), else that or more. Zero in contact, when one lies inside of the other, and
  // when FCL throws.
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

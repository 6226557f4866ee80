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
#include "core/audit/recorded_scene.h"
#include "core/base/problem.h"
#include "core/model/cell.h"
#include "core/model/kinematics.h"

namespace armloom {

// A link, an object of the scene or a held object: one FCL object per collision element.
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
  std::optional<LinkId> link;     // nullopt if an object
  std::optional<LinkId> carrier;  // `link`, or the link that holds the object
  std::optional<ArmId> arm;       // nullopt if stationary
  std::optional<Shape> shape;     // of an object
  // Pose in the carrier's frame C (identity for a link), or in the world if there is no carrier.
  Eigen::Isometry3d X_CL = Eigen::Isometry3d::Identity();
  std::vector<Element> elements;
  double radius_m = 0.0;  // bounding sphere about the link's origin
  Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
  double travel_m = 0.0;         // upper bound of the path length of each of its points so far
  bool elements_placed = false;  // the FCL objects are placed at X_WL

  [[nodiscard]] bool is_held() const { return carrier && !link; }
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
  // Contains the objects of the cell at first; the arms are at home. Fails if a mesh has no data.
  [[nodiscard]] static Result<AuditedCell> build(const Cell& cell);

  // Replaces all objects, and the pairs that may touch. Keeps the FCL objects of links, and of
  // objects with the same name and shape, and what is known of their distances. Preconditions: each
  // mesh has data, and an arm moves each link that holds an object.
  void set_scene(const Cell& cell, const RecordedScene& scene);

  // Moves all links to q, with what they hold, and adds to each solid's travel.
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
  using Place = std::size_t;  // in `solids_`
  // Returns for each solid its place before, or kNew.
  [[nodiscard]] std::vector<Place> replace_objects(const Cell& cell, const RecordedScene& scene);
  void replace_pairs(const Cell& cell, const RecordedScene& scene,
                     const std::vector<Place>& places_before);
  void move(AuditedSolid& solid) const;
  void place_elements(AuditedSolid& solid) const;
  static constexpr Place kNew = static_cast<Place>(-1);

  std::vector<AuditedSolid> solids_;  // in this order: links, objects of the scene, held objects
  std::size_t links_end_ = 0;         // end of the links in `solids_`
  std::vector<AuditedPair> pairs_;    // ascending by (a, b)
  LinkPoses X_WL_;
};

// Finds objects with a mesh that has not been loaded.
void find_unloaded_meshes(const RecordedScene& scene, Problems& problems);

}  // namespace armloom

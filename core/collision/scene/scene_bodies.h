#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/collision/scene/link_capsules.h"
#include "core/collision/scene/pair_limits.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"
#include "core/coordination/verdict.h"
#include "core/geometry/ball.h"
#include "core/geometry/convex/convex_shape.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"
#include "core/model/kinematics.h"

namespace armloom {

// Convex shapes that move together: a link, a single box of a static link, an object, or an
// attached object.
struct CollisionBody {
  std::string name;
  std::optional<LinkId> link;     // nullopt: an object
  std::optional<LinkId> carrier;  // moves the body: its link, or the link it is attached to
  std::optional<ArmId> arm;       // moves the body; nullopt: it is static
  std::optional<RobotId> robot;   // nullopt: an object that is not attached
  // Pose in the carrier, or in the world without one; the identity for a link.
  Eigen::Isometry3d X_CP = Eigen::Isometry3d::Identity();
  std::size_t shapes_begin = 0;  // range in Bodies::shapes
  std::size_t shapes_end = 0;
  struct BoundingSphere {
    Eigen::Vector3d p_PC = Eigen::Vector3d::Zero();  // its center
    double radius_m = 0.0;
  } sphere = {};
  bool has_pieces = false;  // shapes include pieces of a closed mesh
  bool lone_box = false;    // its only shape is a box, for which a sphere is a poor bound
  LinkCapsules fitted;      // in P

  [[nodiscard]] bool held() const { return carrier && !link; }
  // Returns the pose in the world. Precondition: `X_WL` has the poses of all links.
  [[nodiscard]] Eigen::Isometry3d pose(const LinkPoses& X_WL) const {
    if (!carrier) return X_CP;
    return link ? X_WL[carrier->index()] : X_WL[carrier->index()] * X_CP;
  }
};

// Returns the evidence for two bodies that are `clearance_m` apart.
[[nodiscard]] inline Proximity proximity_of(const CollisionBody& a, const CollisionBody& b,
                                            double clearance_m) {
  return {a.name, b.name, a.arm, b.arm, !b.carrier, clearance_m, a.held(), b.held()};
}

// Two bodies that must not touch. The first belongs to the group's `arm`.
struct BodyPair {
  std::size_t a;
  std::size_t b;
};

// A clearance of zero still forbids contact, in which distances are zero.
inline constexpr double kTouching_m = 1e-9;

// All pairs of an arm with one counterpart, checked or skipped together. The kind determines the
// limit, and how conflicts, the monitor and metrics classify the pair.
struct PairGroup {
  enum class Kind {
    arms,   // links and attached objects of two arms
    still,  // an arm against static objects and links, except its mount
    mount,  // an arm against its mount: as `still`, with another limit (Cell::is_mount)
    self,   // an arm against itself: its links and attached objects
  };
  Kind kind;
  ArmId arm;
  std::optional<ArmId> other;   // Kind::arms only, and larger than arm
  std::size_t pairs_begin = 0;  // range in Bodies::pairs
  std::size_t pairs_end = 0;

  [[nodiscard]] double limit_m(const PairLimits& limits) const {
    const double limit_m = kind == Kind::self ? limits.self_clearance_m
                           : kind == Kind::mount
                               ? std::min(limits.mount_clearance_m, limits.clearance_m)
                               : limits.clearance_m;
    return std::max(limit_m, kTouching_m);
  }
};

// Pairs are in the order of their groups: arms by (arm, other), then still and mount by arm, then
// self by arm. Within a group they are sorted by link, then attached object, then object.
struct PlanningScene::Bodies {
  CellPtr cell;
  std::vector<CollisionObject> objects;
  std::shared_ptr<const std::vector<Attachment>> attachments;  // shared while objects change
  // Links in the order of their ids, then attached objects, then objects.
  std::vector<CollisionBody> bodies;
  std::size_t links_end = 0;  // end of the links in `bodies`
  // Claimed pairs (AllowedCollisions) that are proven out of reach; equal in all scenes of a cell.
  std::shared_ptr<const std::set<LinkPair>> out_of_reach;
  std::size_t held_end = 0;  // end of the attached objects, which begin at links_end
  std::vector<ConvexShape> shapes;
  std::vector<BodyPair> pairs;
  std::vector<PairGroup> groups;
  std::vector<std::vector<std::size_t>> bodies_of_arm;  // by ArmId
  std::vector<Ball> reach;                              // by ArmId (reach_of)
  SceneFingerprint links_fingerprint;                   // of the links alone
  SceneFingerprint fingerprint;

  [[nodiscard]] const PairGroup& group_of(PairId pair) const {
    return *std::ranges::upper_bound(groups, pair.index(), {}, &PairGroup::pairs_end);
  }
};

}  // namespace armloom

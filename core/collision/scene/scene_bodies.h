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

// Shapes that move together: a link, one box of a static link, an object, or an attached object.
struct CollisionBody {
  std::string name;
  std::optional<LinkId> link;     // nullopt: an object
  std::optional<LinkId> carrier;  // moves the body: its link, or the link it is attached to
  std::optional<ArmId> arm;       // moves the body; nullopt: it is static
  std::optional<RobotId> robot;   // nullopt: a static object
  // Pose in the carrier, or in the world; identity for a link.
  Eigen::Isometry3d X_CP = Eigen::Isometry3d::Identity();
  std::size_t shapes_begin = 0;  // range in Bodies::shapes
  std::size_t shapes_end = 0;
  struct BoundingSphere {
    Eigen::Vector3d p_PC = Eigen::Vector3d::Zero();  // its center
    double radius_m = 0.0;
  } sphere = {};
  bool has_pieces = false;  // of a closed mesh, among its shapes
  bool lone_box = false;    // its only shape is a box: a sphere would be a poor bound
  LinkCapsules fitted;      // in P

  [[nodiscard]] bool held() const { return carrier && !link; }
  // `X_WL`: of all links.
  [[nodiscard]] Eigen::Isometry3d pose(const LinkPoses& X_WL) const {
    if (!carrier) return X_CP;
    return link ? X_WL[carrier->index()] : X_WL[carrier->index()] * X_CP;
  }
};

[[nodiscard]] inline Proximity proximity_of(const CollisionBody& a, const CollisionBody& b,
                                            double clearance_m) {
  return {a.name, b.name, a.arm, b.arm, !b.carrier, clearance_m, a.held(), b.held()};
}

// The first body belongs to the group's `arm`.
struct BodyPair {
  std::size_t a;
  std::size_t b;
};

// A clearance of zero still forbids contact, where distances are zero.
inline constexpr double kTouching_m = 1e-9;

// All pairs with one counterpart, checked or skipped together. Limits, conflicts, the monitor and
// metrics go by the kind.
struct PairGroup {
  enum class Kind {
    arms,   // links and attached objects of two arms
    still,  // an arm and static bodies, except its mount
    mount,  // an arm and its mount (Cell::is_mount): scene with another limit
    self,   // an arm and itself, attached objects included
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

// Pairs are sorted by group: arms by (arm, other), then still and mount by arm, then self by arm.
// Within a group: by link, attached object, object.
struct PlanningScene::Bodies {
  CellPtr cell;
  std::vector<CollisionObject> objects;
  std::shared_ptr<const std::vector<Attachment>> attachments;  // shared while objects change
  // Links in the order of their ids, attached objects, objects.
  std::vector<CollisionBody> bodies;
  std::size_t links_end = 0;  // in `bodies`
  // Proven claimed pairs (AllowedCollisions); equal in all scenes of a cell.
  std::shared_ptr<const std::set<LinkPair>> out_of_reach;
  std::size_t held_end = 0;  // attached objects: from links_end to it
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

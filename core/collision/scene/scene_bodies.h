#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
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

// Shapes that move together: those of a link, of an object or of an attached object, or one box of
// a static link. P is the body's frame.
struct CollisionBody {
  std::string name;
  std::optional<LinkId> link;     // nullopt if an object
  std::optional<LinkId> carrier;  // the body's link, or the link that carries it
  std::optional<ArmId> arm;       // the arm that moves the body; nullopt if static
  std::optional<RobotId> robot;   // nullopt if a static object
  // Pose of the body in the carrier's frame C (identity for a link), or in the world if there is no
  // carrier.
  Eigen::Isometry3d X_CP = Eigen::Isometry3d::Identity();
  // Range in Bodies::shapes. Objects of the same shape share it.
  std::size_t shapes_begin = 0;
  std::size_t shapes_end = 0;
  struct BoundingSphere {
    Eigen::Vector3d p_PC = Eigen::Vector3d::Zero();  // the sphere's center
    double radius_m = 0.0;
  } sphere = {};
  bool has_pieces = false;  // some shapes are pieces of a closed mesh
  bool lone_box = false;    // its only shape is a box: a sphere would be a poor bound
  LinkCapsules fitted;      // capsules around all shapes, in P
  // Objects only: hash of the name, the shape, the pose and AllowedTouch; and the links that may
  // touch the object.
  Fingerprint content = 0;
  std::vector<LinkId> touched_by = {};

  [[nodiscard]] bool held() const { return carrier && !link; }
  // Returns the body's pose in the world. `X_WL`: poses of all links.
  [[nodiscard]] Eigen::Isometry3d pose(const LinkPoses& X_WL) const {
    if (!carrier) return X_CP;
    return link ? X_WL[carrier->index()] : X_WL[carrier->index()] * X_CP;
  }
};

[[nodiscard]] inline Proximity proximity_of(const CollisionBody& a, const CollisionBody& b,
                                            double clearance_m) {
  return {a.name, b.name, a.arm, b.arm, !b.carrier, clearance_m, a.held(), b.held()};
}

// Two indices in Bodies::bodies. The first body belongs to the group's `arm`.
struct BodyPair {
  std::size_t a;
  std::size_t b;
};

// Smallest limit (m). It forbids contact, where distances are zero, even if the clearance is zero.
inline constexpr double kTouching_m = 1e-9;

// All pairs of an arm with one counterpart. They are checked or skipped together. Limits,
// conflicts, the monitor and metrics distinguish groups by their kind.
struct PairGroup {
  enum class Kind {
    arms,   // links and attached objects of two arms
    still,  // an arm and static bodies, except its mount
    mount,  // an arm and its mount (Cell::is_mount): like still, with another limit
    self,   // an arm and itself, attached objects included
  };
  Kind kind;
  ArmId arm;
  std::optional<ArmId> other;   // Kind::arms only; has the larger id
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

// A shape, by value; meshes by their data. Two shapes with the same key are the same.
using ShapeKey = std::tuple<std::size_t, std::array<double, 3>, const MeshData*>;
[[nodiscard]] ShapeKey key_of(const Shape& shape);

// An object's shape as the checks use it. Fitting takes up to milliseconds, so that scenes share
// it: a change of the scene fits only shapes that the scene before did not have.
struct FittedShape {
  Shape shape;  // keeps the data of a mesh
  std::vector<ConvexShape> convex;
  LinkCapsules fitted;
  CollisionBody::BoundingSphere sphere;
};
using FittedShapes = std::map<ShapeKey, std::shared_ptr<const FittedShape>>;

// The bodies of a scene and the pairs to check. Groups, and their pairs, are in this order:
// - Kind::arms by (arm, other)
// - Kind::still and Kind::mount by arm
// - Kind::self by arm
// Within a group, pairs are sorted by first body, then by second body.
struct PlanningScene::Bodies {
  CellPtr cell;
  std::vector<CollisionObject> objects;
  std::shared_ptr<const std::vector<Attachment>> attachments;  // shared while objects change
  std::vector<AllowedTouch> touch;
  // In this order: links by id, attached objects, objects.
  std::vector<CollisionBody> bodies;
  std::size_t links_end = 0;  // end of the links in `bodies`
  // Pairs from pairs_out_of_reach(); equal in all scenes of a cell.
  std::shared_ptr<const std::set<LinkPair>> out_of_reach;
  std::size_t held_end = 0;  // attached objects: [links_end, held_end) in `bodies`
  std::vector<ConvexShape> shapes;
  FittedShapes fitted;  // of the objects
  std::vector<BodyPair> pairs;
  std::vector<PairGroup> groups;
  std::vector<std::vector<std::size_t>> bodies_of_arm;  // by ArmId
  std::vector<Ball> reach;             // by ArmId: ball around the arm at all positions (reach_of)
  SceneFingerprint links_fingerprint;  // of the scene without objects and attached objects
  SceneFingerprint fingerprint;

  [[nodiscard]] const PairGroup& group_of(PairId pair) const {
    return *std::ranges::upper_bound(groups, pair.index(), {}, &PairGroup::pairs_end);
  }
};

}  // namespace armloom

#include "core/collision/scene/scene_fingerprint.h"

#include <algorithm>

#include "core/base/content_hash.h"
#include "core/collision/scene/arm_reach.h"
#include "core/geometry/mesh/mesh.h"

namespace armloom {
namespace {

template <class Derived>
void add(ContentHash& hash, const Eigen::DenseBase<Derived>& matrix) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) hash.add(matrix(row, column));
  }
}

void add(ContentHash& hash, const Eigen::Isometry3d& pose) {
  add(hash, pose.matrix().topRows<3>());
}

void add(ContentHash& hash, const Box& box) { add(hash, box.size_m); }
void add(ContentHash& hash, const Cylinder& cylinder) {
  hash.add(cylinder.radius_m);
  hash.add(cylinder.length_m);
}
void add(ContentHash& hash, const Sphere& sphere) { hash.add(sphere.radius_m); }
void add(ContentHash& hash, const Mesh& mesh) {
  if (!mesh.data) return;
  for (const Eigen::Vector3d& vertex : mesh.data->vertices) add(hash, vertex);
  for (const Triangle& triangle : mesh.data->triangles) {
    for (const auto corner : triangle) hash.add(static_cast<std::uint64_t>(corner));
  }
}

void add(ContentHash& hash, const Shape& shape) {
  hash.add(shape.index());
  std::visit([&](const auto& kind) { add(hash, kind); }, shape);
}

void add(ContentHash& hash, const Link& link) {
  hash.add(link.name);
  hash.add(link.parent ? link.parent->index() + 1 : std::size_t{0});
  add(hash, link.X_PJ);
  hash.add(link.driver ? link.driver->index() + 1 : std::size_t{0});
  hash.add(static_cast<std::uint64_t>(link.motion));
  add(hash, link.axis);
  hash.add(link.multiplier);
  hash.add(link.offset);
  for (const PlacedShape& placed : link.shapes) {
    add(hash, placed.shape);
    add(hash, placed.X_LS);
  }
}

void add(ContentHash& hash, const std::set<LinkPair>& pairs) {
  hash.add(pairs.size());
  for (const auto& [a, b] : pairs) {
    hash.add(a.index());
    hash.add(b.index());
  }
}

void add(ContentHash& hash, const AllowedCollisions& allowed) {
  add(hash, allowed.link_pairs);
  add(hash, allowed.cell_file_pairs);
  for (const auto& [link, object] : allowed.link_objects) {
    hash.add(link.index());
    hash.add(object);
  }
}

}  // namespace

SceneFingerprint fingerprint_of_links(const Cell& cell, const std::set<LinkPair>& out_of_reach) {
  ContentHash common;
  common.add(cell.clearances.clearance_m);
  common.add(cell.clearances.self_clearance_m);
  common.add(cell.clearances.mount_limit_m());
  add(common, cell.allowed);
  add(common, out_of_reach);
  std::vector<ContentHash> arms(cell.arms.size());
  for (const Link& link : cell.links) add(link.arm ? arms[link.arm->index()] : common, link);
  SceneFingerprint links{.common = common.value(), .arms = {}, .objects = {}};
  for (const ContentHash& arm : arms) links.arms.push_back(arm.value());
  return links;
}

std::vector<Fingerprint> fingerprint_of_arms(const Cell& cell, const SceneFingerprint& links,
                                             const std::vector<Attachment>& attachments) {
  std::vector<Fingerprint> arms = links.arms;
  for (const Attachment& attachment : attachments) {
    Fingerprint& arm = arms[cell.link(attachment.link).arm->index()];
    ContentHash hash;
    hash.add(arm);
    hash.add(attachment.object.name);
    add(hash, attachment.object.shape);
    hash.add(attachment.link.index());
    add(hash, attachment.X_LO);
    for (const LinkId touch : attachment.touch) hash.add(touch.index());
    hash.add(attachment.touch_objects.size());
    for (const std::string& touch : attachment.touch_objects) hash.add(touch);
    for (const Attachment::Other& other : attachment.others) hash.add(other.link.index());
    arm = hash.value();
  }
  return arms;
}

Fingerprint fingerprint_of_object(const CollisionObject& object, const AllowedTouch* touch) {
  ContentHash hash;
  hash.add(object.name);
  add(hash, object.shape);
  add(hash, object.X_WO);
  if (touch != nullptr) {
    for (const LinkId link : touch->links) hash.add(link.index());
  }
  return hash.value();
}

std::vector<std::vector<Fingerprint>> fingerprint_of_objects(const PlanningScene::Bodies& bodies) {
  std::vector<std::vector<Fingerprint>> by_arm(bodies.reach.size());
  for (std::size_t i = bodies.held_end; i < bodies.bodies.size(); ++i) {
    const CollisionBody& object = bodies.bodies[i];
    const Ball ball{object.X_CP * object.sphere.p_PC, object.sphere.radius_m};
    for (std::size_t arm = 0; arm < by_arm.size(); ++arm) {
      if (out_of_reach(bodies.reach[arm], ball, bodies.cell->clearances.clearance_m)) continue;
      by_arm[arm].push_back(object.content);
    }
  }
  for (std::vector<Fingerprint>& objects : by_arm) std::ranges::sort(objects);
  return by_arm;
}

}  // namespace armloom

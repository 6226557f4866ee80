#include "core/collision/scene/planning_scene.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/out_of_reach.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/scene/scene_fingerprint.h"
#include "core/collision/scene/scene_problems.h"

namespace armloom {
namespace {

// Sets the body's bounding sphere, centered in the common bounding box of its shapes.
void bound(const std::vector<ConvexShape>& shapes, CollisionBody& body) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = body.shapes_begin; i < body.shapes_end; ++i) {
    const Eigen::Vector3d p = shapes[i].X_PS.translation();
    const Eigen::Vector3d half =
        shapes[i].X_PS.linear().col(2).cwiseAbs() * shapes[i].half_length_m +
        Eigen::Vector3d::Constant(shapes[i].radius_m);
    box.extend(p - half);
    box.extend(p + half);
  }
  body.sphere.p_PC = box.center();
  for (std::size_t i = body.shapes_begin; i < body.shapes_end; ++i) {
    const Eigen::Vector3d p = shapes[i].X_PS.translation() - body.sphere.p_PC;
    const Eigen::Vector3d half = shapes[i].X_PS.linear().col(2) * shapes[i].half_length_m;
    const double ends = std::max((p + half).norm(), (p - half).norm());
    body.sphere.radius_m = std::max(body.sphere.radius_m, ends + shapes[i].radius_m);
  }
}

void add_body(PlanningScene::Bodies& scene, CollisionBody body,
              const std::vector<PlacedShape>& shapes) {
  if (shapes.empty()) return;
  body.shapes_begin = scene.shapes.size();
  std::vector<ConvexShape> convex = make_convex_shapes(shapes);
  body.has_pieces = std::ranges::any_of(convex, &ConvexShape::is_piece);
  body.fitted = fit_capsules(convex);
  scene.shapes.insert(scene.shapes.end(), std::make_move_iterator(convex.begin()),
                      std::make_move_iterator(convex.end()));
  body.shapes_end = scene.shapes.size();
  bound(scene.shapes, body);
  body.lone_box =
      body.shapes_end == body.shapes_begin + 1 && scene.shapes.back().kind == ConvexShapeKind::box;
  if (body.arm) scene.bodies_of_arm[body.arm->index()].push_back(scene.bodies.size());
  scene.bodies.push_back(std::move(body));
}

// Adds a link as one body. Each box of a static link becomes a body of its own, like a box object,
// because a sphere or capsule is a poor bound of a table.
void add_link(PlanningScene::Bodies& scene, LinkId id) {
  const Cell& cell = *scene.cell;
  const Link& link = cell.link(id);
  CollisionBody body;
  body.name = link.name;
  body.link = body.carrier = id;
  body.arm = link.arm;
  body.robot = link.robot;
  if (link.arm) return add_body(scene, std::move(body), link.shapes);
  std::vector<PlacedShape> others;
  for (const PlacedShape& placed : link.shapes) {
    if (std::holds_alternative<Box>(placed.shape)) {
      add_body(scene, body, {placed});
    } else {
      others.push_back(placed);
    }
  }
  add_body(scene, std::move(body), others);
}

// Returns true if the attached object may touch the other body.
bool held_allowed(const PlanningScene::Bodies& scene, std::size_t held,
                  const CollisionBody& other) {
  if (!other.carrier) return false;
  const Attachment& attachment = (*scene.attachments)[held - scene.links_end];
  if (hand_of(*scene.cell, attachment.link)[other.carrier->index()]) return true;
  if (!other.link) return false;
  return std::ranges::find(attachment.touch, *other.link) != attachment.touch.end() ||
         scene.cell->allowed.link_objects.contains({*other.link, attachment.object.name});
}

bool allowed(const PlanningScene::Bodies& scene, std::size_t index_a, std::size_t index_b) {
  const CollisionBody& a = scene.bodies[index_a];
  const CollisionBody& b = scene.bodies[index_b];
  if (a.held()) return held_allowed(scene, index_a, b);
  if (b.held()) return held_allowed(scene, index_b, a);
  if (!b.link) return scene.cell->allowed.link_objects.contains({*a.link, b.name});
  return scene.cell->allowed.allows(*a.link, *b.link) ||
         scene.out_of_reach->contains(std::minmax(*a.link, *b.link));
}

// Adds the pairs of the arm's bodies with the bodies that `wanted` selects, as one group. Leaves
// out pairs that may touch.
template <class Wanted>
void add_group(PlanningScene::Bodies& scene, PairGroup group, const Wanted& wanted) {
  group.pairs_begin = scene.pairs.size();
  for (const std::size_t a : scene.bodies_of_arm[group.arm.index()]) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      if (b == a || !wanted(a, scene.bodies[b], b)) continue;
      if (allowed(scene, a, b)) continue;
      scene.pairs.push_back({a, b});
    }
  }
  group.pairs_end = scene.pairs.size();
  if (group.pairs_end > group.pairs_begin) scene.groups.push_back(group);
}

void add_pairs(PlanningScene::Bodies& scene) {
  using Kind = PairGroup::Kind;
  const Cell& cell = *scene.cell;
  const auto arm_count = static_cast<std::uint32_t>(cell.arms.size());
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    for (std::uint32_t j = i + 1; j < arm_count; ++j) {
      add_group(scene, {Kind::arms, ArmId{i}, ArmId{j}},
                [&](std::size_t, const CollisionBody& body, std::size_t) {
                  return body.arm == ArmId{j};
                });
    }
  }
  const auto is_mount = [&](const CollisionBody& body, ArmId arm) {
    return body.link && cell.is_mount(*body.link, arm);
  };
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    add_group(scene, {Kind::still, ArmId{i}, std::nullopt},
              [&](std::size_t, const CollisionBody& body, std::size_t) {
                return !body.arm && !is_mount(body, ArmId{i});
              });
    add_group(scene, {Kind::mount, ArmId{i}, std::nullopt},
              [&](std::size_t, const CollisionBody& body, std::size_t) {
                return is_mount(body, ArmId{i});
              });
  }
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    add_group(scene, {Kind::self, ArmId{i}, std::nullopt},
              [&](std::size_t a, const CollisionBody& body, std::size_t b) {
                return body.arm == ArmId{i} && b > a;
              });
  }
}

void cut(PlanningScene::Bodies& scene, std::size_t end) {
  if (end == scene.bodies.size()) return;
  scene.shapes.resize(scene.bodies[end].shapes_begin);
  scene.bodies.resize(end);
  for (auto& bodies : scene.bodies_of_arm) {
    std::erase_if(bodies, [end](std::size_t body) { return body >= end; });
  }
}

void add_held(PlanningScene::Bodies& scene) {
  for (const Attachment& attachment : *scene.attachments) {
    const Link& link = scene.cell->link(attachment.link);
    CollisionBody body;
    body.name = attachment.object.name;
    body.carrier = attachment.link;
    body.arm = link.arm;
    body.robot = link.robot;
    body.X_CP = attachment.X_LO;
    add_body(scene, std::move(body), {{attachment.object.shape, Eigen::Isometry3d::Identity()}});
  }
  scene.held_end = scene.bodies.size();
}

void set_reach(PlanningScene::Bodies& scene) {
  scene.reach.clear();
  for (std::uint32_t a = 0; a < scene.cell->arms.size(); ++a) {
    scene.reach.push_back(reach_of(scene, ArmId{a}));
  }
}

// Precondition: the attached objects are the last bodies.
void add_objects(PlanningScene::Bodies& scene) {
  for (const CollisionObject& object : scene.objects) {
    CollisionBody body;
    body.name = object.name;
    body.X_CP = object.X_WO;
    add_body(scene, std::move(body), {{object.shape, Eigen::Isometry3d::Identity()}});
  }
  scene.fingerprint.objects = fingerprint_of_objects(scene);
  scene.pairs.clear();
  scene.groups.clear();
  add_pairs(scene);
}

}  // namespace

PlanningScene::PlanningScene() : bodies_(std::make_unique<Bodies>()) {}
PlanningScene::~PlanningScene() = default;
const Cell& PlanningScene::cell() const { return *bodies_->cell; }
const PlanningScene::Bodies& PlanningScene::bodies() const { return *bodies_; }
const SceneFingerprint& PlanningScene::fingerprint() const { return bodies_->fingerprint; }

const std::vector<CollisionObject>& PlanningScene::objects() const { return bodies_->objects; }
const std::vector<Attachment>& PlanningScene::attachments() const { return *bodies_->attachments; }

bool PlanningScene::holds_as(const PlanningScene& other) const {
  return bodies_->attachments == other.bodies_->attachments ||
         (attachments().empty() && other.attachments().empty());
}

Result<PlanningScenePtr> PlanningScene::build(CellPtr cell) {
  Problems problems;
  find_link_problems(*cell, problems);
  find_object_problems(cell->objects, {}, problems);
  find_unknown_allowed(*cell, problems);
  if (!problems.empty()) return failure(std::move(problems));

  PlanningScene links;  // without objects at first
  Bodies& bodies = *links.bodies_;
  bodies.cell = cell;
  bodies.attachments = std::make_shared<const std::vector<Attachment>>();
  bodies.bodies_of_arm.resize(cell->arms.size());
  for (std::uint32_t i = 0; i < cell->links.size(); ++i) add_link(bodies, LinkId{i});
  bodies.links_end = bodies.held_end = bodies.bodies.size();
  set_reach(bodies);
  bodies.out_of_reach = std::make_shared<const std::set<LinkPair>>(pairs_out_of_reach(bodies));
  bodies.links_fingerprint = bodies.fingerprint = fingerprint_of_links(*cell, *bodies.out_of_reach);
  return links.with_objects(cell->objects);
}

Result<PlanningScenePtr> PlanningScene::with_objects(std::vector<CollisionObject> objects) const {
  Problems problems;
  find_object_problems(objects, attachments(), problems);
  if (!problems.empty()) return failure(std::move(problems));

  const std::shared_ptr<PlanningScene> scene(new PlanningScene);
  Bodies& bodies = *scene->bodies_;
  bodies = *bodies_;
  cut(bodies, bodies.held_end);
  bodies.objects = std::move(objects);
  add_objects(bodies);
  return PlanningScenePtr(scene);
}

Result<PlanningScenePtr> PlanningScene::with_attachments(
    std::vector<Attachment> attachments) const {
  Problems problems;
  find_attachment_problems(cell(), objects(), attachments, problems);
  if (!problems.empty()) return failure(std::move(problems));

  const std::shared_ptr<PlanningScene> scene(new PlanningScene);
  Bodies& bodies = *scene->bodies_;
  bodies = *bodies_;
  cut(bodies, bodies.links_end);
  bodies.attachments = std::make_shared<const std::vector<Attachment>>(std::move(attachments));
  bodies.fingerprint.arms =
      fingerprint_of_arms(cell(), bodies.links_fingerprint, *bodies.attachments);
  add_held(bodies);
  set_reach(bodies);
  add_objects(bodies);
  return PlanningScenePtr(scene);
}

}  // namespace armloom

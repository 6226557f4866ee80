#include "core/collision/scene/planning_scene.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/out_of_reach.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/scene/scene_fingerprint.h"
#include "core/collision/scene/scene_problems.h"

namespace armloom {
namespace {

auto at(const std::vector<ConvexShape>& shapes, std::size_t index) {
  return shapes.begin() + static_cast<std::ptrdiff_t>(index);
}

// Returns the bounding sphere of shapes, centered in their common bounding box.
CollisionBody::BoundingSphere bound(const std::vector<ConvexShape>& shapes) {
  Eigen::AlignedBox3d box;
  for (const ConvexShape& shape : shapes) {
    const Eigen::Vector3d p = shape.X_PS.translation();
    const Eigen::Vector3d half = shape.X_PS.linear().col(2).cwiseAbs() * shape.half_length_m +
                                 Eigen::Vector3d::Constant(shape.radius_m);
    box.extend(p - half);
    box.extend(p + half);
  }
  CollisionBody::BoundingSphere sphere{box.center(), 0.0};
  for (const ConvexShape& shape : shapes) {
    const Eigen::Vector3d p = shape.X_PS.translation() - sphere.p_PC;
    const Eigen::Vector3d half = shape.X_PS.linear().col(2) * shape.half_length_m;
    const double ends = std::max((p + half).norm(), (p - half).norm());
    sphere.radius_m = std::max(sphere.radius_m, ends + shape.radius_m);
  }
  return sphere;
}

void add_body(PlanningScene::Bodies& scene, CollisionBody body) {
  body.has_pieces =
      std::any_of(at(scene.shapes, body.shapes_begin), at(scene.shapes, body.shapes_end),
                  [](const ConvexShape& shape) { return shape.is_piece; });
  body.lone_box = body.shapes_end == body.shapes_begin + 1 &&
                  scene.shapes[body.shapes_begin].kind == ConvexShapeKind::box;
  if (body.arm) scene.bodies_of_arm[body.arm->index()].push_back(scene.bodies.size());
  scene.bodies.push_back(std::move(body));
}

void add_body(PlanningScene::Bodies& scene, CollisionBody body,
              const std::vector<PlacedShape>& shapes) {
  if (shapes.empty()) return;
  body.shapes_begin = scene.shapes.size();
  std::vector<ConvexShape> convex = make_convex_shapes(shapes);
  body.fitted = fit_capsules(convex);
  body.sphere = bound(convex);
  std::ranges::move(convex, std::back_inserter(scene.shapes));
  body.shapes_end = scene.shapes.size();
  add_body(scene, std::move(body));
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
  const Attachment& attachment = (*scene.attachments)[held - scene.links_end];
  if (!other.carrier) return std::ranges::count(attachment.touch_objects, other.name) > 0;
  const auto is_in_hand = [&](LinkId link) -> bool {
    return hand_of(*scene.cell, link)[other.carrier->index()];
  };
  if (is_in_hand(attachment.link)) return true;
  if (std::ranges::any_of(attachment.others, is_in_hand, &Attachment::Other::link)) return true;
  if (!other.link) return false;
  return std::ranges::find(attachment.touch, *other.link) != attachment.touch.end() ||
         scene.cell->allowed.link_objects.contains({*other.link, attachment.object.name});
}

bool allowed(const PlanningScene::Bodies& scene, std::size_t index_a, std::size_t index_b) {
  const CollisionBody& a = scene.bodies[index_a];
  const CollisionBody& b = scene.bodies[index_b];
  if (a.held()) return held_allowed(scene, index_a, b);
  if (b.held()) return held_allowed(scene, index_b, a);
  if (!b.link) return std::ranges::find(b.touched_by, *a.link) != b.touched_by.end();
  return scene.cell->allowed.allows(*a.link, *b.link) ||
         scene.out_of_reach->contains(std::minmax(*a.link, *b.link));
}

// Adds the pairs of the arm's bodies with `others` (indices, ascending), as one group. Leaves out
// pairs that may touch. Within an arm, each pair is added once.
void add_group(PlanningScene::Bodies& scene, PairGroup group,
               const std::vector<std::size_t>& others) {
  group.pairs_begin = scene.pairs.size();
  for (const std::size_t a : scene.bodies_of_arm[group.arm.index()]) {
    for (const std::size_t b : others) {
      if (group.kind == PairGroup::Kind::self && b <= a) continue;
      if (!allowed(scene, a, b)) scene.pairs.push_back({a, b});
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
      add_group(scene, {Kind::arms, ArmId{i}, ArmId{j}}, scene.bodies_of_arm[j]);
    }
  }
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    std::vector<std::size_t> still, mount;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const CollisionBody& body = scene.bodies[b];
      if (body.arm) continue;
      (body.link && cell.is_mount(*body.link, ArmId{i}) ? mount : still).push_back(b);
    }
    add_group(scene, {Kind::still, ArmId{i}, std::nullopt}, still);
    add_group(scene, {Kind::mount, ArmId{i}, std::nullopt}, mount);
  }
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    add_group(scene, {Kind::self, ArmId{i}, std::nullopt}, scene.bodies_of_arm[i]);
  }
}

void cut(PlanningScene::Bodies& scene, std::size_t end) {
  if (end == scene.bodies.size()) return;
  std::size_t shapes_end = 0;
  for (std::size_t i = 0; i < end; ++i) {
    shapes_end = std::max(shapes_end, scene.bodies[i].shapes_end);
  }
  scene.shapes.resize(shapes_end);
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

// Returns a capsule around a box whose axis is a side of the box, without the search for a smaller
// one: boxes of a scene are compared as boxes, and a camera sends thousands of them.
LinkCapsules around_box(const ConvexShape& box) {
  const Eigen::Matrix3d R = box.X_PS.linear();
  const LinkCapsule capsule =
      fit_capsule(extreme_balls(box), {R.col(0), R.col(1), R.col(2)}, false);
  double depth_m = box.radius_m;  // least distance of the axis from the box's surface
  for (const Eigen::Vector3d& p_P : {capsule.p_PA, capsule.p_PB}) {
    const Eigen::Vector3d p = box.X_PS.inverse(Eigen::Isometry) * p_P;
    depth_m = std::min(depth_m, (box.half_size_m - p.cwiseAbs()).minCoeff());
  }
  return {{capsule}, std::max(0.0, capsule.radius_m - depth_m)};
}

std::shared_ptr<const FittedShape> fit(const Shape& shape) {
  FittedShape fit{shape, make_convex_shapes({{shape, Eigen::Isometry3d::Identity()}}), {}, {}};
  fit.fitted = std::holds_alternative<Box>(shape) ? around_box(fit.convex.front())
                                                  : fit_capsules(fit.convex);
  fit.sphere = bound(fit.convex);
  return std::make_shared<const FittedShape>(std::move(fit));
}

// Adds the objects of the scene, and all pairs. `fitted`: shapes that are fitted already.
// Precondition: the attached objects are the last bodies.
void add_objects(PlanningScene::Bodies& scene, const FittedShapes& fitted) {
  std::map<std::string_view, std::vector<LinkId>> touching;
  for (const auto& [link, object] : scene.cell->allowed.link_objects) {
    touching[object].push_back(link);
  }
  for (const auto& [object, links] : scene.touch) {
    std::ranges::copy(links, std::back_inserter(touching[object]));
  }
  FittedShapes used;
  std::map<ShapeKey, std::pair<std::size_t, std::size_t>> ranges;  // in `shapes`
  for (const CollisionObject& object : scene.objects) {
    const ShapeKey key = key_of(object.shape);
    auto& own = used[key];
    auto& [begin, end] = ranges[key];
    if (own == nullptr) {
      const auto known = fitted.find(key);
      own = known == fitted.end() ? fit(object.shape) : known->second;
      begin = scene.shapes.size();
      std::ranges::copy(own->convex, std::back_inserter(scene.shapes));
      end = scene.shapes.size();
    }
    CollisionBody body;
    body.name = object.name;
    body.X_CP = object.X_WO;
    body.shapes_begin = begin;
    body.shapes_end = end;
    body.sphere = own->sphere;
    body.fitted = own->fitted;
    const auto now = std::ranges::find(scene.touch, object.name, &AllowedTouch::object);
    body.content = fingerprint_of_object(object, now == scene.touch.end() ? nullptr : &*now);
    const auto links = touching.find(object.name);
    if (links != touching.end()) body.touched_by = links->second;
    add_body(scene, std::move(body));
  }
  scene.fitted = std::move(used);
  scene.fingerprint.objects = fingerprint_of_objects(scene);
  scene.pairs.clear();
  scene.groups.clear();
  add_pairs(scene);
}

}  // namespace

ShapeKey key_of(const Shape& shape) {
  std::array<double, 3> numbers{};
  const MeshData* data = nullptr;
  if (const auto* box = std::get_if<Box>(&shape)) {
    numbers = {box->size_m.x(), box->size_m.y(), box->size_m.z()};
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    numbers = {cylinder->radius_m, cylinder->length_m, 0.0};
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    numbers = {sphere->radius_m, 0.0, 0.0};
  } else {
    data = std::get<Mesh>(shape).data.get();
  }
  return {shape.index(), numbers, data};
}

PlanningScene::PlanningScene() : bodies_(std::make_unique<Bodies>()) {}
PlanningScene::~PlanningScene() = default;
const Cell& PlanningScene::cell() const { return *bodies_->cell; }
const PlanningScene::Bodies& PlanningScene::bodies() const { return *bodies_; }
bool PlanningScene::out_of_reach(ArmId a, ArmId b) const {
  return armloom::out_of_reach(bodies_->reach[a.index()], bodies_->reach[b.index()],
                               bodies_->cell->clearances.clearance_m);
}

const SceneFingerprint& PlanningScene::fingerprint() const { return bodies_->fingerprint; }

const std::vector<CollisionObject>& PlanningScene::objects() const { return bodies_->objects; }
const std::vector<Attachment>& PlanningScene::attachments() const { return *bodies_->attachments; }
const std::vector<AllowedTouch>& PlanningScene::touch() const { return bodies_->touch; }

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
  return with({std::move(objects), std::nullopt, touch()});
}

Result<PlanningScenePtr> PlanningScene::with_attachments(
    std::vector<Attachment> attachments) const {
  return with({objects(), std::move(attachments), touch()});
}

Result<PlanningScenePtr> PlanningScene::with(Content content) const {
  Problems problems;
  if (content.attachments) {
    find_object_problems(content.objects, {}, problems);
    find_attachment_problems(cell(), content.objects, *content.attachments, problems);
  } else {
    find_object_problems(content.objects, attachments(), problems);
  }
  if (!problems.empty()) return failure(std::move(problems));

  const std::shared_ptr<PlanningScene> scene(new PlanningScene);
  Bodies& bodies = *scene->bodies_;
  bodies = *bodies_;
  bodies.objects = std::move(content.objects);
  bodies.touch = std::move(content.touch);
  if (content.attachments) {
    cut(bodies, bodies.links_end);
    bodies.attachments =
        std::make_shared<const std::vector<Attachment>>(std::move(*content.attachments));
    bodies.fingerprint.arms =
        fingerprint_of_arms(cell(), bodies.links_fingerprint, *bodies.attachments);
    add_held(bodies);
    set_reach(bodies);
  } else {
    cut(bodies, bodies.held_end);
  }
  add_objects(bodies, bodies_->fitted);
  return PlanningScenePtr(scene);
}

}  // namespace armloom

#include "core/collision/scene/planning_scene.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "core/collision/scene/link_capsules.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/scene/scene_problems.h"

namespace armloom {
namespace {

// A sphere about the middle of the bodies' bounding boxes.
void bound(const std::vector<ConvexShape>& bodies, Part& part) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = part.bodies_begin; i < part.bodies_end; ++i) {
    const Eigen::Vector3d p = bodies[i].X_PS.translation();
    const Eigen::Vector3d half =
        bodies[i].X_PS.linear().col(2).cwiseAbs() * bodies[i].half_length_m +
        Eigen::Vector3d::Constant(bodies[i].radius_m);
    box.extend(p - half);
    box.extend(p + half);
  }
  part.p_PC = box.center();
  for (std::size_t i = part.bodies_begin; i < part.bodies_end; ++i) {
    const Eigen::Vector3d p = bodies[i].X_PS.translation() - part.p_PC;
    const Eigen::Vector3d half = bodies[i].X_PS.linear().col(2) * bodies[i].half_length_m;
    const double ends = std::max((p + half).norm(), (p - half).norm());
    part.radius_m = std::max(part.radius_m, ends + bodies[i].radius_m);
  }
}

void add_part(PlanningScene::Bodies& scene, Part part, const std::vector<PlacedShape>& shapes) {
  if (shapes.empty()) return;
  part.bodies_begin = scene.bodies.size();
  std::vector<ConvexShape> bodies = make_convex_shapes(shapes);
  part.has_pieces = std::ranges::any_of(bodies, &ConvexShape::is_piece);
  LinkCapsules fitted = fit_capsules(bodies);
  part.capsules = std::move(fitted.capsules);
  part.capsule_overestimate_m = fitted.overestimate_m;
  scene.bodies.insert(scene.bodies.end(), std::make_move_iterator(bodies.begin()),
                      std::make_move_iterator(bodies.end()));
  part.bodies_end = scene.bodies.size();
  bound(scene.bodies, part);
  part.lone_box =
      part.bodies_end == part.bodies_begin + 1 && scene.bodies.back().kind == ConvexShapeKind::box;
  if (part.arm) scene.parts_of_arm[part.arm->index()].push_back(scene.parts.size());
  scene.parts.push_back(std::move(part));
}

// A link is one part, as its shapes move as one. Of one that stands still each box is a part, as it
// would be as an object: a sphere, or a capsule, says little about a table.
void add_link(PlanningScene::Bodies& scene, LinkId id) {
  const Cell& cell = *scene.cell;
  const Link& link = cell.link(id);
  Part part;
  part.name = link.name;
  part.link = part.carrier = id;
  part.arm = link.arm;
  part.robot = link.robot;
  if (link.arm) return add_part(scene, std::move(part), link.shapes);
  std::vector<PlacedShape> others;
  for (const PlacedShape& placed : link.shapes) {
    if (std::holds_alternative<Box>(placed.shape)) {
      add_part(scene, part, {placed});
    } else {
      others.push_back(placed);
    }
  }
  add_part(scene, std::move(part), others);
}

// What is held, against anything.
bool held_allowed(const PlanningScene::Bodies& scene, std::size_t held, const Part& other) {
  if (!other.carrier) return false;
  const Attachment& attachment = (*scene.attachments)[held - scene.links_end];
  if (hand_of(*scene.cell, attachment.link)[other.carrier->index()]) return true;
  if (!other.link) return false;
  return std::ranges::find(attachment.touch, *other.link) != attachment.touch.end() ||
         scene.cell->allowed_link_objects.contains({*other.link, attachment.object.name});
}

bool allowed(const PlanningScene::Bodies& scene, std::size_t index_a, std::size_t index_b) {
  const Part& a = scene.parts[index_a];
  const Part& b = scene.parts[index_b];
  if (a.held()) return held_allowed(scene, index_a, b);
  if (b.held()) return held_allowed(scene, index_b, a);
  if (!b.link) return scene.cell->allowed_link_objects.contains({*a.link, b.name});
  return scene.cell->allowed_link_pairs.contains(std::minmax(*a.link, *b.link));
}

// Adds the pairs of the arm's parts with all parts that `wanted` names, as one group.
template <class Wanted>
void add_group(PlanningScene::Bodies& scene, PairGroup group, const Wanted& wanted) {
  group.pairs_begin = scene.pairs.size();
  for (const std::size_t a : scene.parts_of_arm[group.arm.index()]) {
    for (std::size_t b = 0; b < scene.parts.size(); ++b) {
      if (b == a || !wanted(a, scene.parts[b], b)) continue;
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
                [&](std::size_t, const Part& part, std::size_t) { return part.arm == ArmId{j}; });
    }
  }
  const auto is_mount = [&](const Part& part, ArmId arm) {
    return part.link && cell.is_mount(*part.link, arm);
  };
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    add_group(scene, {Kind::still, ArmId{i}, std::nullopt},
              [&](std::size_t, const Part& part, std::size_t) {
                return !part.arm && !is_mount(part, ArmId{i});
              });
    add_group(scene, {Kind::mount, ArmId{i}, std::nullopt},
              [&](std::size_t, const Part& part, std::size_t) { return is_mount(part, ArmId{i}); });
  }
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    add_group(scene, {Kind::self, ArmId{i}, std::nullopt},
              [&](std::size_t a, const Part& part, std::size_t b) {
                return part.arm == ArmId{i} && b > a;
              });
  }
}

// Parts from `end` on are taken away.
void cut(PlanningScene::Bodies& scene, std::size_t end) {
  if (end == scene.parts.size()) return;
  scene.bodies.resize(scene.parts[end].bodies_begin);
  scene.parts.resize(end);
  for (auto& parts : scene.parts_of_arm) {
    std::erase_if(parts, [end](std::size_t part) { return part >= end; });
  }
}

void add_held(PlanningScene::Bodies& scene) {
  for (const Attachment& attachment : *scene.attachments) {
    const Link& link = scene.cell->link(attachment.link);
    Part part;
    part.name = attachment.object.name;
    part.carrier = attachment.link;
    part.arm = link.arm;
    part.robot = link.robot;
    part.X_CP = attachment.X_LO;
    add_part(scene, std::move(part), {{attachment.object.shape, Eigen::Isometry3d::Identity()}});
  }
  scene.held_end = scene.parts.size();
}

// Precondition: the parts end with what is held.
void add_objects(PlanningScene::Bodies& scene) {
  for (const CollisionObject& object : scene.objects) {
    Part part;
    part.name = object.name;
    part.X_CP = object.X_WO;
    add_part(scene, std::move(part), {{object.shape, Eigen::Isometry3d::Identity()}});
  }
  scene.pairs.clear();
  scene.groups.clear();
  add_pairs(scene);
}

}  // namespace

PlanningScene::PlanningScene() : bodies_(std::make_unique<Bodies>()) {}
PlanningScene::~PlanningScene() = default;
const Cell& PlanningScene::cell() const { return *bodies_->cell; }
const PlanningScene::Bodies& PlanningScene::bodies() const { return *bodies_; }

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

  PlanningScene links;  // without objects yet
  Bodies& bodies = *links.bodies_;
  bodies.cell = cell;
  bodies.attachments = std::make_shared<const std::vector<Attachment>>();
  bodies.parts_of_arm.resize(cell->arms.size());
  for (std::uint32_t i = 0; i < cell->links.size(); ++i) add_link(bodies, LinkId{i});
  bodies.links_end = bodies.held_end = bodies.parts.size();
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
  add_held(bodies);
  add_objects(bodies);
  return PlanningScenePtr(scene);
}

}  // namespace armloom

#include "core/collision/planning_scene.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "core/collision/link_capsules.h"
#include "core/collision/scene_bodies.h"

namespace armloom {
namespace {

// Meshes are read when a cell is built, not here.
std::optional<Problem> mesh_problem(const Shape& shape, const std::string& pointer) {
  const auto* mesh = std::get_if<Mesh>(&shape);
  if (mesh == nullptr || mesh->data != nullptr) return std::nullopt;
  return Problem{ProblemKind::unsupported, "mesh-not-loaded", pointer,
                 "the mesh " + mesh->path + " has not been loaded", mesh->path};
}

void find_link_problems(const Cell& cell, Problems& problems) {
  for (const Link& link : cell.links) {
    for (const PlacedShape& placed : link.shapes) {
      auto problem = mesh_problem(placed.shape, "link " + link.name);
      if (problem) problems.push_back(*std::move(problem));
    }
  }
}

void find_object_problems(const std::vector<CollisionObject>& objects, Problems& problems) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string pointer = "/objects/" + std::to_string(i);
    auto problem = mesh_problem(objects[i].shape, pointer + "/mesh");
    if (problem) problems.push_back(*std::move(problem));
    const std::string& name = objects[i].name;
    if (names.insert(name).second) continue;
    problems.push_back({ProblemKind::conflict, "name-taken", pointer + "/name",
                        "two objects are named " + name, name});
  }
}

// Only at the start: an object of the cell file may be taken away later.
void find_unknown_allowed(const Cell& cell, Problems& problems) {
  std::set<std::string> names;
  for (const CollisionObject& object : cell.objects) names.insert(object.name);
  for (const auto& [link, object] : cell.allowed_link_objects) {
    if (names.contains(object)) continue;
    problems.push_back(
        {ProblemKind::invalid, "unknown-name", "/allowed_collisions",
         "no object is named " + object + " (allowed to touch " + cell.link(link).name + ")",
         object});
  }
}

// A sphere about the middle of the bodies' bounding boxes.
void bound(const std::vector<Body>& bodies, Part& part) {
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
  std::vector<Body> bodies = make_bodies(shapes);
  LinkCapsules fitted = fit_capsules(bodies);
  part.capsules = std::move(fitted.capsules);
  part.capsule_excess_m = fitted.excess_m;
  scene.bodies.insert(scene.bodies.end(), std::make_move_iterator(bodies.begin()),
                      std::make_move_iterator(bodies.end()));
  part.bodies_end = scene.bodies.size();
  bound(scene.bodies, part);
  part.lone_box =
      part.bodies_end == part.bodies_begin + 1 && scene.bodies.back().kind == BodyKind::box;
  if (part.arm) scene.parts_of_arm[part.arm->index()].push_back(scene.parts.size());
  scene.parts.push_back(std::move(part));
}

bool allowed(const Cell& cell, const Part& a, const Part& b) {
  if (!b.link) return cell.allowed_link_objects.contains({*a.link, b.name});
  return cell.allowed_link_pairs.contains(std::minmax(*a.link, *b.link));
}

// Adds the pairs of the arm's parts with all parts that `wanted` names, as one group.
template <class Wanted>
void add_group(PlanningScene::Bodies& scene, PairGroup group, const Wanted& wanted) {
  group.pairs_begin = scene.pairs.size();
  for (const std::size_t a : scene.parts_of_arm[group.arm.index()]) {
    for (std::size_t b = 0; b < scene.parts.size(); ++b) {
      if (b == a || !wanted(a, scene.parts[b], b)) continue;
      if (allowed(*scene.cell, scene.parts[a], scene.parts[b])) continue;
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
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    const RobotId robot = cell.arms[i].robot;
    add_group(scene, {Kind::still, ArmId{i}, std::nullopt},
              [&](std::size_t, const Part& part, std::size_t) {
                return !part.arm && part.robot != robot;
              });
  }
  for (std::uint32_t i = 0; i < arm_count; ++i) {
    const RobotId robot = cell.arms[i].robot;
    add_group(scene, {Kind::self, ArmId{i}, std::nullopt},
              [&](std::size_t a, const Part& part, std::size_t b) {
                return (part.arm == ArmId{i} && b > a) || (!part.arm && part.robot == robot);
              });
  }
}

}  // namespace

PlanningScene::PlanningScene() : bodies_(std::make_unique<Bodies>()) {}
PlanningScene::~PlanningScene() = default;
const Cell& PlanningScene::cell() const { return *bodies_->cell; }
const PlanningScene::Bodies& PlanningScene::bodies() const { return *bodies_; }

const std::vector<CollisionObject>& PlanningScene::objects() const { return bodies_->objects; }

Result<PlanningScenePtr> PlanningScene::build(CellPtr cell) {
  Problems problems;
  find_link_problems(*cell, problems);
  find_object_problems(cell->objects, problems);
  find_unknown_allowed(*cell, problems);
  if (!problems.empty()) return failure(std::move(problems));

  PlanningScene links;  // without objects yet
  Bodies& bodies = *links.bodies_;
  bodies.cell = cell;
  bodies.parts_of_arm.resize(cell->arms.size());
  for (std::size_t i = 0; i < cell->links.size(); ++i) {
    const Link& link = cell->links[i];
    Part part;
    part.name = link.name;
    part.link = LinkId{static_cast<std::uint32_t>(i)};
    part.arm = link.arm;
    part.robot = link.robot;
    add_part(bodies, std::move(part), link.shapes);
  }
  bodies.links_end = bodies.parts.size();
  return links.with_objects(cell->objects);
}

Result<PlanningScenePtr> PlanningScene::with_objects(std::vector<CollisionObject> objects) const {
  Problems problems;
  find_object_problems(objects, problems);
  if (!problems.empty()) return failure(std::move(problems));

  const std::shared_ptr<PlanningScene> scene(new PlanningScene);
  Bodies& bodies = *scene->bodies_;
  bodies = *bodies_;
  if (bodies.links_end < bodies.parts.size()) {
    bodies.bodies.resize(bodies.parts[bodies.links_end].bodies_begin);
    bodies.parts.resize(bodies.links_end);
  }
  bodies.pairs.clear();
  bodies.groups.clear();
  for (const CollisionObject& object : objects) {
    Part part;
    part.name = object.name;
    add_part(bodies, std::move(part), {{object.shape, Eigen::Isometry3d::Identity()}});
  }
  bodies.objects = std::move(objects);
  add_pairs(bodies);
  return PlanningScenePtr(scene);
}

}  // namespace armloom

#include "test/bench/moveit_way.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/convex/convex_shape.h"
#include "core/model/kinematics.h"
#include "test/bench/link_mesh.h"

namespace armloom::bench {
namespace {

constexpr std::size_t kTrianglesPerLink = 252;  // requested; the result has 248
using MeshModel = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<MeshModel> bvh_of(const LinkMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<MeshModel>();
  model->beginModel();
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

class AllowedPairs {
 public:
  explicit AllowedPairs(std::size_t bodies) : bodies_(bodies), allowed_(bodies * bodies, 0) {}
  void allow(std::size_t a, std::size_t b) { allowed_[a * bodies_ + b] = 1; }
  [[nodiscard]] bool operator()(std::size_t a, std::size_t b) const {
    return allowed_[a * bodies_ + b] != 0;
  }

 private:
  std::size_t bodies_;
  std::vector<std::uint8_t> allowed_;
};

struct Query {
  const AllowedPairs& allowed;
  bool collision = false;
};

std::size_t body_of(const fcl::CollisionObjectd& object) {
  return static_cast<std::size_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
}

// Called by FCL for objects with overlapping boxes; true ends the search.
bool collide_pair(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
  Query& query = *static_cast<Query*>(data);
  if (query.collision) return true;
  if (query.allowed(body_of(*a), body_of(*b))) return false;
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  query.collision = fcl::collide(a, b, request, result) > 0;
  return query.collision;
}

}  // namespace

struct MoveItWay::Scene {
  using Object = fcl::CollisionObjectd;

  CellPtr cell;
  std::vector<LinkId> links;                    // links with shapes
  std::vector<std::shared_ptr<Object>> robot;   // by links; copied for each state
  std::vector<std::unique_ptr<Object>> things;  // the cell's objects
  fcl::DynamicAABBTreeCollisionManagerd world;
  AllowedPairs allowed{0};
  std::size_t triangles = 0;
  LinkPoses X_WL;

  explicit Scene(CellPtr c) : cell(std::move(c)) {
    add_links();
    add_objects();
    allow();
  }

  static void number(Object& object, std::size_t body) {
    object.setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(body)));
  }

  void add_links() {
    for (std::size_t i = 0; i < cell->links.size(); ++i) {
      if (cell->links[i].shapes.empty()) continue;
      const LinkMesh mesh =
          circumscribed_mesh(make_convex_shapes(cell->links[i].shapes), kTrianglesPerLink);
      triangles += mesh.triangles.size();
      robot.push_back(std::make_shared<Object>(bvh_of(mesh)));
      number(*robot.back(), links.size());
      links.emplace_back(static_cast<std::uint32_t>(i));
    }
  }

  void add_objects() {
    for (const CollisionObject& object : cell->objects) {
      const Box* box = std::get_if<Box>(&object.shape);
      if (box == nullptr) throw std::invalid_argument(object.name + " is no box");
      things.push_back(
          std::make_unique<Object>(std::make_shared<fcl::Boxd>(box->size_m), object.X_WO));
      things.back()->computeAABB();
      number(*things.back(), links.size() + things.size() - 1);
      world.registerObject(things.back().get());
    }
    world.setup();
  }

  void allow() {
    const std::size_t count = links.size();
    allowed = AllowedPairs(count + things.size());
    const auto set = [this](std::size_t a, std::size_t b) {
      allowed.allow(a, b);
      allowed.allow(b, a);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const bool still = !cell->link(links[i]).arm;
      for (std::size_t j = 0; j < count; ++j) {
        if (cell->allowed.allows(links[i], links[j]) || (still && !cell->link(links[j]).arm)) {
          set(i, j);
        }
      }
      for (std::size_t k = 0; k < things.size(); ++k) {
        if (still || cell->allowed.link_objects.contains({links[i], cell->objects[k].name})) {
          set(i, count + k);
        }
      }
    }
  }
};

MoveItWay::MoveItWay(CellPtr cell) : scene_(std::make_unique<Scene>(std::move(cell))) {}
MoveItWay::MoveItWay(MoveItWay&&) noexcept = default;
MoveItWay& MoveItWay::operator=(MoveItWay&&) noexcept = default;
MoveItWay::~MoveItWay() = default;

bool MoveItWay::in_collision(const Configuration& q) {
  Scene& scene = *scene_;
  forward_kinematics(*scene.cell, q, scene.X_WL);

  std::vector<std::shared_ptr<Scene::Object>> placed;
  placed.reserve(scene.links.size());
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    placed.push_back(std::make_shared<Scene::Object>(*scene.robot[i]));
    placed.back()->setTransform(scene.X_WL[scene.links[i].index()]);
    placed.back()->computeAABB();
  }
  fcl::DynamicAABBTreeCollisionManagerd robot;
  std::vector<Scene::Object*> objects;
  objects.reserve(placed.size());
  for (const auto& object : placed) objects.push_back(object.get());
  robot.registerObjects(objects);

  Query query{scene.allowed};
  scene.world.collide(&robot, &query, &collide_pair);
  if (!query.collision) robot.collide(&query, &collide_pair);
  return query.collision;
}

std::size_t MoveItWay::triangles() const { return scene_->triangles; }
std::size_t MoveItWay::meshes() const { return scene_->links.size(); }

}  // namespace armloom::bench

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/verdict.h"
#include "core/model/cell.h"

namespace armloom {

// Everything that a collision query needs and that does not move: the shapes of all links and
// objects as FCL geometry (each cylinder with two end spheres of its radius merged into the exact
// capsule, each mesh its convex hull), and the pairs that must be looked at (the allowed-collision
// matrix, applied). Immutable and shared by all threads; a changed scene is a new one.
class PlanningScene {
 public:
  // Problems: a mesh whose data is missing (Mesh::data), an object name used twice or unknown in
  // the cell's allowed collisions.
  [[nodiscard]] static Result<std::shared_ptr<const PlanningScene>> build(CellPtr cell);
  ~PlanningScene();

  // The same cell with other objects; the links' shapes are shared. Pairs that may touch by an
  // object's name still may. Problems: as build, with pointers "/objects/<index>/...".
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_objects(
      std::vector<CollisionObject> objects) const;
  [[nodiscard]] const std::vector<CollisionObject>& objects() const;

  [[nodiscard]] const Cell& cell() const;

  struct Bodies;  // FCL inside; only core/collision looks at it
  [[nodiscard]] const Bodies& bodies() const;

 private:
  PlanningScene();
  std::unique_ptr<Bodies> bodies_;
};
using PlanningScenePtr = std::shared_ptr<const PlanningScene>;

}  // namespace armloom

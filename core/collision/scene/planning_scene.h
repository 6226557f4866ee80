#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/certificate.h"
#include "core/coordination/verdict.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// Everything that a collision query needs and that does not move: the shapes of all links and
// objects, held ones too (each cylinder with two end spheres of its radius merged into the exact
// capsule; each mesh its convex pieces or hull as FCL geometry and, where it is closed, its
// triangles behind them), and the pairs that must be looked at (the allowed-collision matrix,
// applied). Immutable and shared by all threads; a changed scene is a new one.
class PlanningScene {
 public:
  // Problems: a mesh whose data is missing (Mesh::data), an object name used twice or unknown in
  // the cell's allowed collisions.
  [[nodiscard]] static Result<std::shared_ptr<const PlanningScene>> build(CellPtr cell);
  ~PlanningScene();

  // The same cell with other objects; the links' shapes are shared, what arms hold stays. Pairs
  // that may touch by an object's name still may. Problems: as build, or a name that a held object
  // has, with pointers "/objects/<index>/...".
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_objects(
      std::vector<CollisionObject> objects) const;
  [[nodiscard]] const std::vector<CollisionObject>& objects() const;

  // The same cell and objects, with these objects held instead of all that were. A held object is a
  // part of the arm that moves its link: it is looked at against everything that links of the arm
  // are, and what other arms hold; and against the arm's own links but its `touch` and the hand
  // that holds it (hand_of). A pair of a link and this name that may touch by the cell file still
  // may. Pairs that the SRDF allows to the carrying link are not allowed to what it carries.
  // Problems: a link or touch that the cell does not have, a link that no arm moves, a name that an
  // object, a link or another attachment has, a mesh without data; with pointers
  // "/attachments/<index>/...".
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_attachments(
      std::vector<Attachment> attachments) const;
  [[nodiscard]] const std::vector<Attachment>& attachments() const;
  // Whether both scenes were made from one call of with_attachments(), or hold nothing: links and
  // held objects are the same then, given the same cell.
  [[nodiscard]] bool holds_as(const PlanningScene& other) const;

  [[nodiscard]] const Cell& cell() const;
  // The content of the scene, for certificates.
  [[nodiscard]] const SceneFingerprint& fingerprint() const;

  struct Bodies;  // FCL inside; only core/collision looks at it
  [[nodiscard]] const Bodies& bodies() const;

 private:
  PlanningScene();
  std::unique_ptr<Bodies> bodies_;
};
// A pair of bodies that a scene looks at (PlanningScene::Bodies::pairs), in the scene's order.
using PairId = Id<struct PairTag>;
using PlanningScenePtr = std::shared_ptr<const PlanningScene>;

}  // namespace armloom

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

// The immutable part of every collision query, shared by all threads; a change makes a new scene.
// It has the shapes of all links, objects and attached objects, and the pairs to check (after the
// allowed-collision matrix). A cylinder with two end spheres of its radius becomes one exact
// capsule. A mesh becomes its convex pieces or its hull as FCL geometry, with its triangles if it
// is closed.
class PlanningScene {
 public:
  // Problems: a mesh without data (Mesh::data), an object name that is used twice or is unknown in
  // the cell's allowed collisions.
  [[nodiscard]] static Result<std::shared_ptr<const PlanningScene>> build(CellPtr cell);
  ~PlanningScene();

  // Returns the scene with other objects; link shapes are shared, attached objects stay. Pairs that
  // are allowed to touch by an object's name stay allowed. Problems: as for build(), or the name of
  // an attached object; pointers are "/objects/<index>/...".
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_objects(
      std::vector<CollisionObject> objects) const;
  [[nodiscard]] const std::vector<CollisionObject>& objects() const;

  // Returns the scene with these attached objects instead of all present ones. An attached object
  // is part of the arm that moves its link. It is checked against everything that the arm's links
  // are checked against, against attached objects of other arms, and against the arm's own links
  // except `touch` and the hand that holds it (hand_of). Pairs of a link and an object name that
  // the cell file allows stay allowed. Pairs that the SRDF allows for the carrying link do not
  // apply to its attached object.
  //
  // Problems, with pointers "/attachments/<index>/...": an unknown link or touch, a link that no
  // arm moves, a name that an object, a link or another attachment has, a mesh without data.
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_attachments(
      std::vector<Attachment> attachments) const;
  [[nodiscard]] const std::vector<Attachment>& attachments() const;
  // Returns true if both scenes come from the same call of with_attachments(), or have no attached
  // objects. For the same cell, their links and attached objects are then equal.
  [[nodiscard]] bool holds_as(const PlanningScene& other) const;

  [[nodiscard]] const Cell& cell() const;
  // Returns hashes of the scene's content, for certificates.
  [[nodiscard]] const SceneFingerprint& fingerprint() const;

  struct Bodies;  // contains FCL types; for core/collision only
  [[nodiscard]] const Bodies& bodies() const;

 private:
  PlanningScene();
  std::unique_ptr<Bodies> bodies_;
};
// A pair of bodies that a scene checks (PlanningScene::Bodies::pairs), in the scene's order.
using PairId = Id<struct PairTag>;
using PlanningScenePtr = std::shared_ptr<const PlanningScene>;

}  // namespace armloom

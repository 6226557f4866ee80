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

// The immutable part of collision queries: shapes of all links, objects and attached objects, and
// the pairs to check (after the allowed-collision matrix). A cylinder with two end spheres of its
// radius becomes one exact capsule; a mesh becomes convex pieces or its hull as FCL geometry, and
// its triangles if it is closed. Shared by all threads; a change makes a new scene.
class PlanningScene {
 public:
  // Problems: a mesh without data (Mesh::data), an object name that is used twice or is unknown in
  // the allowed collisions.
  [[nodiscard]] static Result<std::shared_ptr<const PlanningScene>> build(CellPtr cell);
  ~PlanningScene();

  // Returns the scene with other objects; link shapes are shared, attached objects stay. Pairs
  // allowed by an object's name stay allowed. Problems, with pointers "/objects/<index>/...": as
  // for build(), or an attached object's name.
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_objects(
      std::vector<CollisionObject> objects) const;
  [[nodiscard]] const std::vector<CollisionObject>& objects() const;

  // Returns the scene with only these attached objects. An attached object is part of the arm that
  // moves its link. It is checked against everything that the arm's links are checked against,
  // against attached objects of other arms, and against the arm's own links except `touch` and the
  // hand that holds it (hand_of). Pairs of a link and an object name in the cell file stay allowed.
  // SRDF pairs of the carrying link do not apply to the object.
  //
  // Problems, with pointers "/attachments/<index>/...": an unknown link or touch, a link that no
  // arm moves, a name in use, a mesh without data.
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_attachments(
      std::vector<Attachment> attachments) const;
  [[nodiscard]] const std::vector<Attachment>& attachments() const;
  // Returns true if both scenes come from the same call of with_attachments(), or have no attached
  // objects: links and attached objects are then equal, given the same cell.
  [[nodiscard]] bool holds_as(const PlanningScene& other) const;

  [[nodiscard]] const Cell& cell() const;
  // The scene's content as hashes, for certificates.
  [[nodiscard]] const SceneFingerprint& fingerprint() const;

  struct Bodies;  // has FCL types; for core/collision only
  [[nodiscard]] const Bodies& bodies() const;

 private:
  PlanningScene();
  std::unique_ptr<Bodies> bodies_;
};
// A pair that a scene checks (PlanningScene::Bodies::pairs), in the scene's order.
using PairId = Id<struct PairTag>;
using PlanningScenePtr = std::shared_ptr<const PlanningScene>;

}  // namespace armloom

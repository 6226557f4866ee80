#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/certificate.h"
#include "core/coordination/verdict.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// The immutable part of collision queries: the shapes of all links, objects and attached objects,
// and the pairs of bodies to check. Pairs in the allowed-collision matrix are left out.
// A cylinder with an end sphere of its radius at each end becomes one exact capsule. A mesh becomes
// its convex pieces or its hull; if it is closed, its triangles are also kept. Threads share a
// scene; every change creates a new scene.
class PlanningScene {
 public:
  // Problems: a mesh without data (Mesh::data), two objects with the same name, an unknown object
  // name in the allowed collisions.
  [[nodiscard]] static Result<std::shared_ptr<const PlanningScene>> build(CellPtr cell);
  ~PlanningScene();

  // Returns a scene with these objects instead of the present objects. Link shapes are shared, and
  // attached objects stay. Pairs that are allowed by an object's name stay allowed.
  // Problems, with pointers "/objects/<index>/...": a mesh without data, two objects with the same
  // name, an object with the name of an attached object.
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_objects(
      std::vector<CollisionObject> objects) const;
  [[nodiscard]] const std::vector<CollisionObject>& objects() const;

  // Returns a scene with these attached objects instead of the present attached objects. An
  // attached object becomes part of the arm that moves its link. The object is checked against
  // - everything that the arm's links are checked against,
  // - attached objects of other arms,
  // - the arm's own links, except `touch` and the hand that holds the object (hand_of).
  // Pairs of a link and an object name that the cell file allows stay allowed. An SRDF that
  // disables pairs of the carrying link has no effect on the object.
  //
  // Problems, with pointers "/attachments/<index>/...": an unknown link or touch, a link that no
  // arm moves, a name in use, a mesh without data.
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with_attachments(
      std::vector<Attachment> attachments) const;
  [[nodiscard]] const std::vector<Attachment>& attachments() const;

  // The parts of the scene that may change while the server runs.
  struct Content {
    std::vector<CollisionObject> objects;
    std::optional<std::vector<Attachment>> attachments = {};  // nullopt: unchanged
    std::vector<AllowedTouch> touch = {};                     // by name, also of future objects
  };
  // Returns a scene with this content. Problems: those of with_objects() and with_attachments().
  [[nodiscard]] Result<std::shared_ptr<const PlanningScene>> with(Content content) const;
  [[nodiscard]] const std::vector<AllowedTouch>& touch() const;
  // Returns true if both scenes have the attached objects of the same call of with_attachments(),
  // or no attached objects. Then their links and attached objects are equal if their cell is the
  // same.
  [[nodiscard]] bool holds_as(const PlanningScene& other) const;

  [[nodiscard]] const Cell& cell() const;
  // Returns hashes of the scene's content, for certificates.
  [[nodiscard]] const SceneFingerprint& fingerprint() const;

  // Returns true if the two arms, with what they hold, keep clearance_m at all their positions.
  [[nodiscard]] bool out_of_reach(ArmId a, ArmId b) const;

  struct Bodies;  // defined in scene_bodies.h; for core/collision only
  [[nodiscard]] const Bodies& bodies() const;

 private:
  PlanningScene();
  std::unique_ptr<Bodies> bodies_;
};
// The index of a pair of bodies that the scene checks (PlanningScene::Bodies::pairs).
using PairId = Id<struct PairTag>;
using PlanningScenePtr = std::shared_ptr<const PlanningScene>;

}  // namespace armloom

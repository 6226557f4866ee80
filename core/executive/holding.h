#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"
#include "core/executive/events.h"
#include "core/jobs/shared_hold.h"
#include "core/model/cell.h"

namespace armloom {

// An object is attached only if it is at most this far from the hand (m).
inline constexpr double kAttachWithin_m = 0.02;

// By object: the links that hold it. The first one carries it.
using HandsOf = std::map<std::string, std::vector<LinkId>>;

// Links and objects of the scene that an object may touch at present, besides the hand that holds
// it.
struct Touch {
  std::vector<LinkId> links = {};
  std::vector<std::string> objects = {};

  // Adds what is not there yet. Afterwards, both lists are ascending.
  void add(const Touch& more);
  bool operator==(const Touch&) const = default;
};

// Return the content of the scene after a change of what the arms hold. Pure.

// The link carries the object from now on, where both are. An object that other links hold changes
// hands; if it is `shared`, they hold it too, and the first of them carries it on. `measured`:
// positions of all joints. Problems, with pointers into an attach step:
// - "unknown-object": neither in the scene nor carried
// - "too-far": no part of the hand is within kAttachWithin_m
// - those of find_overload()
// - "not-held": no link holds the object that is to be shared
// - "held-twice": an object is to be shared that the arm holds
// Precondition: an arm moves the link.
[[nodiscard]] Result<PlanningScene::Content> attached(const PlanningScene& scene,
                                                      const Configuration& measured,
                                                      const std::string& object, LinkId link,
                                                      Touch touch, bool shared = false);
// The link, or each one if there is none, holds the object no more. If no other link holds it, the
// object is part of the scene from now on, where it is. The hand may still touch it. Problems:
// "not-held" if the link, or no link, holds the object.
[[nodiscard]] Result<PlanningScene::Content> detached(const PlanningScene& scene,
                                                      const Configuration& measured,
                                                      const std::string& object,
                                                      std::optional<LinkId> link = {});
// The object, carried or not, may touch only this. Ignores an unknown object.
[[nodiscard]] PlanningScene::Content touching(const PlanningScene& scene, const std::string& object,
                                              Touch touch);

// Returns what the object, carried or not, may touch at present; lists are ascending.
[[nodiscard]] Touch touch_in(const PlanningScene& scene, const std::string& object);

// Returns the object's place. Precondition: the object is in the scene, or carried.
[[nodiscard]] HeldView place_of(const PlanningScene& scene, const std::string& object);
// Returns what place_of() has described. Problems: "unknown-link".
[[nodiscard]] Result<Attachment> attachment_of(const Cell& cell, const HeldView& view);
// Returns the content in which these hands hold the object; others do not. `held.object.X_WO` is
// not used.
[[nodiscard]] PlanningScene::Content holding(const PlanningScene& scene, Attachment held);

// Returns the problem that the scene has no such object ("unknown-object").
[[nodiscard]] Problem no_object(const std::string& name);
// Returns the link that carries the object; nullopt if none does.
[[nodiscard]] std::optional<LinkId> carrier_of(const PlanningScene& scene,
                                               const std::string& object);
// Returns the links that hold the object, the carrier first.
[[nodiscard]] std::vector<LinkId> hands_at(const PlanningScene& scene, const std::string& object);
// Returns the links that hold each object of the scene.
[[nodiscard]] HandsOf hands_of(const PlanningScene& scene);
// Returns the objects that several arms hold.
[[nodiscard]] std::vector<SharedHold> shared_holds(const Cell& cell, const HandsOf& hands);
// Returns the links of the hand to which the link belongs (hand_of), the link included.
[[nodiscard]] std::vector<LinkId> links_of_hand(const Cell& cell, LinkId link);
// Returns the arms that move the links, ascending.
[[nodiscard]] std::vector<ArmId> arms_of(const Cell& cell, const std::vector<LinkId>& links);

}  // namespace armloom

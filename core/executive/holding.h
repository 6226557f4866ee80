#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"
#include "core/executive/events.h"
#include "core/model/cell.h"

namespace armloom {

// An object is attached only if it is at most this far from the hand (m).
inline constexpr double kAttachWithin_m = 0.02;

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

// The link carries the object from now on, where both are. An object that another link carries
// changes hands. `measured`: positions of all joints. Problems, with pointers into an attach step:
// - "unknown-object": neither in the scene nor carried
// - "too-far": no part of the hand is within kAttachWithin_m
// - those of find_overload()
// Precondition: an arm moves the link.
[[nodiscard]] Result<PlanningScene::Content> attached(const PlanningScene& scene,
                                                      const Configuration& measured,
                                                      const std::string& object, LinkId link,
                                                      Touch touch);
// The object is part of the scene from now on, where it is. The hand may still touch it. Problems:
// "not-held" if no link carries the object.
[[nodiscard]] Result<PlanningScene::Content> detached(const PlanningScene& scene,
                                                      const Configuration& measured,
                                                      const std::string& object);
// The object, carried or not, may touch only this. Ignores an unknown object.
[[nodiscard]] PlanningScene::Content touching(const PlanningScene& scene, const std::string& object,
                                              Touch touch);

// Returns what the object, carried or not, may touch at present; lists are ascending.
[[nodiscard]] Touch touch_in(const PlanningScene& scene, const std::string& object);

// Returns the object's place. Precondition: the object is in the scene, or carried.
[[nodiscard]] HeldView place_of(const PlanningScene& scene, const std::string& object);
// Returns the content in which this link carries the object, with its pose in the link's frame.
[[nodiscard]] PlanningScene::Content holding(const PlanningScene& scene, CollisionObject object,
                                             LinkId link);

// Returns the problem that the scene has no such object ("unknown-object").
[[nodiscard]] Problem no_object(const std::string& name);
// Returns the link that carries the object; nullopt if none does.
[[nodiscard]] std::optional<LinkId> carrier_of(const PlanningScene& scene,
                                               const std::string& object);
// Returns the links of the hand to which the link belongs (hand_of), the link included.
[[nodiscard]] std::vector<LinkId> links_of_hand(const Cell& cell, LinkId link);

}  // namespace armloom

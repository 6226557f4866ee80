#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/collision/planning_scene.h"
#include "core/coordination/verdict.h"
#include "core/model/cell.h"

namespace armloom {

// A pair of bodies that the scene looks at (PlanningScene::Bodies::pairs), in the scene's order.
using PairId = Id<struct PairTag>;

// A pair that is too close. clearance_m is negative by the depth of overlap where that is known
// (capsules and spheres, against each other and against boxes), zero in contact otherwise.
struct NearPair {
  PairId pair;
  double clearance_m;
  double limit_m;  // what was asked of it
};

// Asks one scene about single configurations of the whole cell. Holds the scratch: one per worker
// thread, not thread-safe. What nothing proves apart counts as contact (clearance 0). Distances are
// never larger than the true ones, nor smaller by more than 2e-7 m but in rare cases
// (exact_distance.h) and for closed meshes that are farther apart than kSurfaceWithin_m: these may
// be told the distance of their convex pieces, or that one (part_distance.h). What an arm holds is
// one of its links in all that follows. Configurations have one entry per joint of the cell (throws
// std::invalid_argument otherwise), arm masks one per arm. A `clearance_m` asked for is what arms
// keep from each other and from the scene; an arm is held to its shares of that from itself and
// its mount (PairLimits::scaled).
class CollisionChecker {
 public:
  explicit CollisionChecker(PlanningScenePtr scene);
  CollisionChecker(CollisionChecker&&) noexcept;
  CollisionChecker& operator=(CollisionChecker&&) noexcept;
  ~CollisionChecker();

  [[nodiscard]] const PlanningScene& scene() const;

  // The first pair found that is closer than `clearance_m` and involves a link moved by one of
  // `arms` (indexed by ArmId; true: look at it): against other arms, static links, itself and the
  // objects. Not the closest: the scene's pair order, so that it is deterministic. Nullopt: none.
  [[nodiscard]] std::optional<Proximity> first_closer_than(const Configuration& q,
                                                           double clearance_m,
                                                           const std::vector<bool>& arms);

  // Every pair (allowed ones left out) closer than `clearance_m`, as above: the closest of each
  // pair of arms, of each arm with the objects and static links, and of each arm with itself.
  [[nodiscard]] std::vector<Proximity> all_closer_than(const Configuration& q, double clearance_m);

  // The closest pair of each two arms, and of each arm with all that stands still (but for what
  // its first joint alone moves, with its mount), as exact as said above when below `horizon_m`;
  // pairs farther apart are left out.
  [[nodiscard]] std::vector<Proximity> closest_apart(const Configuration& q, double horizon_m);

  // Every pair closer than `clearance_m` that involves a link of one of the arms in `of` and a link
  // of one of the arms in `moved`, in the scene's order; `near` is overwritten (no allocation once
  // it has grown). What judge() is built on: pairs can be followed from state to state.
  void near_pairs(const Configuration& q, double clearance_m, const std::vector<bool>& of,
                  const std::vector<bool>& moved, std::vector<NearPair>& near);
  // Whether near_pairs would look at this pair.
  [[nodiscard]] bool looks_at(PairId pair, const std::vector<bool>& of,
                              const std::vector<bool>& moved) const;
  // Names and arms. body_a belongs to the arm with the smaller id; body_b to the other, or it is a
  // static link or an object.
  [[nodiscard]] Proximity describe(const NearPair& near) const;
  // Both bodies are one arm's own (Cell::is_own), or held by it.
  [[nodiscard]] bool is_self(PairId pair) const;
  // An arm and its mount, and not its own.
  [[nodiscard]] bool is_mount(PairId pair) const;

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace armloom

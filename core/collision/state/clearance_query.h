#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/collision/scene/pair_limits.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A pair that is too close. clearance_m is negative by the depth of overlap where that is known
// (capsules and spheres, against each other and against boxes), zero in contact otherwise.
struct NearPair {
  PairId pair;
  double clearance_m;
  double limit_m;  // what was asked of it
};

// Asks one scene about configurations of the whole cell: which pairs are closer than their limits?
// Capsules answer for nearly all pairs; for those that they leave open, and only for these, the
// exact distance does. What nothing proves apart counts as contact (clearance 0). Distances are
// never larger than the true ones, nor smaller by more than 2e-7 m but in rare cases
// (exact_distance.h) and for closed meshes that are farther apart than kSurfaceWithin_m: these may
// be told the distance of their convex pieces, or that one (body_distance.h). What an arm holds is
// one of its links in all that follows. Configurations have one entry per joint of the cell (throws
// std::invalid_argument otherwise), arm masks one per arm. Holds the scratch: one per worker
// thread, not thread-safe.
class ClearanceQuery {
 public:
  // Without limits: the cell's.
  explicit ClearanceQuery(PlanningScenePtr scene);
  ClearanceQuery(PlanningScenePtr scene, const PairLimits& limits);
  ClearanceQuery(ClearanceQuery&&) noexcept;
  ClearanceQuery& operator=(ClearanceQuery&&) noexcept;
  ~ClearanceQuery();

  [[nodiscard]] const PlanningScene& scene() const;
  void set_limits(const PairLimits& limits);

  // Up to eight states at once, one bit for each, the first one lowest: some pair is closer than
  // its limit. The soonest answer: no distance is told.
  [[nodiscard]] unsigned too_close(std::span<const Configuration* const> states);

  // Every such pair of a link of one of the arms in `of` and a link of one of the arms in `moved`,
  // in the scene's order; `near` is overwritten.
  void near_pairs(const Configuration& q, const std::vector<bool>& of,
                  const std::vector<bool>& moved, std::vector<NearPair>& near);
  [[nodiscard]] std::vector<NearPair> near_pairs(const Configuration& q);
  // Whether near_pairs would look at this pair.
  [[nodiscard]] bool looks_at(PairId pair, const std::vector<bool>& of,
                              const std::vector<bool>& moved) const;

  // The closest of these pairs: of each two arms, of each arm with the objects and static links,
  // its mount, and itself.
  [[nodiscard]] std::vector<Proximity> closest_too_close(const Configuration& q);
  // Whatever the limits, the closest pair of each two arms, and of each arm with all that stands
  // still, when closer than `horizon_m`.
  [[nodiscard]] std::vector<Proximity> closest_apart(const Configuration& q, double horizon_m);

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

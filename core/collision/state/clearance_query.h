#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/collision/scene/pair_limits.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A pair that is closer than its limit. In contact, clearance_m is minus the penetration depth if
// the depth is known, else zero. The depth is known for capsules and spheres, against each other
// and against boxes.
struct NearPair {
  PairId pair;
  double clearance_m;
  double limit_m;  // required distance
};

// Finds the pairs of a scene that are closer than their limits, for configurations of the whole
// cell. Capsules decide nearly all pairs; exact distances decide the others. A pair that is not
// proven apart is reported as in contact (clearance 0).
//
// Distances are never larger than the true distances. They are smaller by at most 2e-7 m, except
// - in rare cases (exact_distance.h),
// - for closed meshes farther apart than kSurfaceWithin_m (body_distance.h).
//
// Attached objects are treated as links of their arm. A configuration has one entry per joint of
// the cell; otherwise all queries but too_close() throw std::invalid_argument. An arm mask (`of`,
// `moved`) has one entry per arm. Not thread-safe: use one query per worker thread.
class ClearanceQuery {
 public:
  // Uses the cell's limits if none are passed.
  explicit ClearanceQuery(PlanningScenePtr scene);
  ClearanceQuery(PlanningScenePtr scene, const PairLimits& limits);
  ClearanceQuery(ClearanceQuery&&) noexcept;
  ClearanceQuery& operator=(ClearanceQuery&&) noexcept;
  ~ClearanceQuery();

  [[nodiscard]] const PlanningScene& scene() const;
  void set_limits(const PairLimits& limits);

  // Checks up to eight states. Bit i of the result is set if a pair in state i is closer than its
  // limit. The fastest query.
  [[nodiscard]] unsigned too_close(std::span<const Configuration* const> states);

  // Writes to `near` every pair that is closer than its limit and that involves an arm in `of` and
  // an arm in `moved`, possibly the same arm. Pairs are in the scene's order.
  void near_pairs(const Configuration& q, const std::vector<bool>& of,
                  const std::vector<bool>& moved, std::vector<NearPair>& near);
  [[nodiscard]] std::vector<NearPair> near_pairs(const Configuration& q);
  [[nodiscard]] bool looks_at(PairId pair, const std::vector<bool>& of,
                              const std::vector<bool>& moved) const;

  // Returns the closest pair of each group (PairGroup), if it is closer than its limit.
  [[nodiscard]] std::vector<Proximity> closest_too_close(const Configuration& q);
  struct Closest {
    std::vector<Proximity> apart;  // of each two arms, and of each arm with static bodies
    // Pairs of an arm with what it stands on, because their distances hardly change:
    // - all links with the bodies of Cell::is_mount, and with objects that these may touch
    // - the link that only the arm's first joint moves, with any static body
    // Such a pair is in `apart` if it is closer than three times Cell::clearances.clearance_m.
    std::vector<Proximity> at_mount;
  };
  // Returns the closest pairs that are closer than `horizon_m`, whatever their limits are.
  [[nodiscard]] Closest closest_apart(const Configuration& q, double horizon_m);

  // Returns the names and arms of the two bodies. body_a belongs to the arm with the smaller id.
  // body_b belongs to the other arm, or is a static link or an object.
  [[nodiscard]] Proximity describe(const NearPair& near) const;
  // Returns true if both bodies belong to one arm (Cell::is_own), attached objects included.
  [[nodiscard]] bool is_self(PairId pair) const;
  // Returns true if the bodies belong to an arm and its mount (Cell::is_mount).
  [[nodiscard]] bool is_mount(PairId pair) const;

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace armloom

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/collision/scene/pair_limits.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A pair that is too close. In contact, clearance_m is minus the depth if that is known (capsules
// and spheres, against each other and boxes), else zero.
struct NearPair {
  PairId pair;
  double clearance_m;
  double limit_m;  // required distance
};

// Finds the pairs of a scene that are closer than their limits, for configurations of the whole
// cell. Capsules decide nearly all pairs, exact distances the rest. A pair that is not proven apart
// counts as contact (clearance 0).
//
// Distances are never larger than the true distances, and smaller by at most 2e-7 m, with rare
// exceptions (exact_distance.h) and except for closed meshes farther apart than kSurfaceWithin_m
// (body_distance.h).
//
// Attached objects are treated as links of their arm. Configurations have one entry per joint of
// the cell (else throws std::invalid_argument), arm masks one per arm. Not thread-safe: use one per
// worker thread.
class ClearanceQuery {
 public:
  // Default limits: the cell's.
  explicit ClearanceQuery(PlanningScenePtr scene);
  ClearanceQuery(PlanningScenePtr scene, const PairLimits& limits);
  ClearanceQuery(ClearanceQuery&&) noexcept;
  ClearanceQuery& operator=(ClearanceQuery&&) noexcept;
  ~ClearanceQuery();

  [[nodiscard]] const PlanningScene& scene() const;
  void set_limits(const PairLimits& limits);

  // Checks up to eight states: bit i is set if a pair in state i is closer than its limit. The
  // fastest query.
  [[nodiscard]] unsigned too_close(std::span<const Configuration* const> states);

  // Writes to `near`, in the scene's order, every such pair that involves an arm in `of` and an arm
  // in `moved`, possibly the same arm.
  void near_pairs(const Configuration& q, const std::vector<bool>& of,
                  const std::vector<bool>& moved, std::vector<NearPair>& near);
  [[nodiscard]] std::vector<NearPair> near_pairs(const Configuration& q);
  [[nodiscard]] bool looks_at(PairId pair, const std::vector<bool>& of,
                              const std::vector<bool>& moved) const;

  // Returns the closest such pair of each two arms, and of each arm with static bodies, with its
  // mount, and with itself.
  [[nodiscard]] std::vector<Proximity> closest_too_close(const Configuration& q);
  // Returns the closest pair of each two arms, and of each arm with all static bodies, if closer
  // than `horizon_m`; ignores the limits.
  [[nodiscard]] std::vector<Proximity> closest_apart(const Configuration& q, double horizon_m);

  // body_a belongs to the arm with the smaller id; body_b to the other arm, a static link or an
  // object.
  [[nodiscard]] Proximity describe(const NearPair& near) const;
  // Returns true if both bodies belong to one arm (Cell::is_own), attached objects included.
  [[nodiscard]] bool is_self(PairId pair) const;
  // Returns true for an arm and its mount (Cell::is_mount).
  [[nodiscard]] bool is_mount(PairId pair) const;

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace armloom

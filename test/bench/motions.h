#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"
#include "test/bench/states.h"

namespace armloom::bench {

inline constexpr double kMotion_s = 10.0;
inline constexpr std::size_t kWaypoints = 100;

// Returns a random motion of one arm: each joint oscillates as a sum of six cosines, at rest at
// both ends, within 60 % of its velocity and 80 % of its acceleration limit. 100 waypoints over 10
// s, through validate(). Deterministic for seed and joint limits. `reach` in (0, 1]: used share of
// each joint's range, around the middle. Throws std::runtime_error if validate() rejects it.
[[nodiscard]] TrajectoryPtr random_motion(const Cell& cell, ArmId arm, std::uint64_t seed,
                                          double reach);

// Returns `motion` with its displacements scaled by `share`, from home to the goal. If `backwards`,
// from the goal to home. nullopt if the result exceeds limits.
[[nodiscard]] std::optional<TrajectoryPtr> from_home(const Cell& cell, ArmId arm,
                                                     const Trajectory& motion, double share,
                                                     bool backwards);

// Motions that start together; other joints rest as in `rest`.
struct Motions {
  CellPtr cell;
  std::vector<TrajectoryPtr> trajectories;
  Configuration rest;

  // Sets q to the state with every motion at `progress` (at most its end).
  void state_at(Duration progress, Configuration& q) const;
  // Sets q as above, but with the i-th motion ahead by `lead` (negative: behind).
  void state_at(Duration progress, std::size_t i, Duration lead, Configuration& q) const;
};

// Samples of two motions, every `step`. At each sample the first motion leads or lags by any
// multiple of `step` up to `band`.
struct SampledBand {
  Duration step;
  Duration band{};
};
// Returns the smallest exact distance between arms in these samples, at most horizon_m. Returns
// early if a distance is below `enough_m`.
[[nodiscard]] double closest_in_band(ExactScene& exact, const Motions& motions,
                                     const SampledBand& sampled, double horizon_m, double enough_m);

// Checks all motions every `step`. Returns true if they keep margin_m from the scene, and margin_m
// * self_clearance_m / clearance_m between links of one arm.
[[nodiscard]] bool clear_of_all_but_arms(ExactScene& exact, const Motions& motions, Duration step,
                                         double margin_m);

}  // namespace armloom::bench

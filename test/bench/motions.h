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

// A smooth random motion of one arm: each joint swings about a random middle as a sum of six
// cosines that begin and end at rest (velocity and acceleration zero), within 60 % of its velocity
// and 80 % of its acceleration limit; 100 waypoints over 10 s with velocities and accelerations,
// through validate(). The same for the same seed and joint limits. `reach` in (0, 1]: the share of
// each joint's range that the motion may use, about the middle of it.
// Throws std::runtime_error when validate refuses it.
[[nodiscard]] TrajectoryPtr random_motion(const Cell& cell, ArmId arm, std::uint64_t seed,
                                          double reach);

// The waypoints of `motion`, its deviation from its start shrunk to `share` and begun at home;
// backwards: from its goal to home. None: it leaves its limits.
[[nodiscard]] std::optional<TrajectoryPtr> from_home(const Cell& cell, ArmId arm,
                                                     const Trajectory& motion, double share,
                                                     bool backwards);

// Motions that run together, each from its beginning at time zero; all other joints stand as in
// `rest`.
struct Motions {
  CellPtr cell;
  std::vector<TrajectoryPtr> trajectories;
  Configuration rest;

  // The combined state with every motion `progress` on its way (its goal, once past the end).
  void state_at(Duration progress, Configuration& q) const;
  // The same with the i-th motion ahead by `lead` (negative: behind).
  void state_at(Duration progress, std::size_t i, Duration lead, Configuration& q) const;
};

// Two motions over their common time, every `step`, with the first ahead of the second by any
// multiple of `step` up to `band` either way.
struct SampledBand {
  Duration step;
  Duration band{};
};
// The smallest exact distance between different arms there. horizon_m when never below it. Stops
// early below `enough_m`.
[[nodiscard]] double closest_in_band(ExactScene& exact, const Motions& motions,
                                     const SampledBand& sampled, double horizon_m, double enough_m);

// Whether all motions, sampled every `step`, keep margin_m from objects and static links and the
// share self_clearance_m / clearance_m of it from themselves; different arms are not compared.
[[nodiscard]] bool clear_of_all_but_arms(ExactScene& exact, const Motions& motions, Duration step,
                                         double margin_m);

}  // namespace armloom::bench

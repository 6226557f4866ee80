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

// Returns a smooth random motion of one arm. Each joint oscillates around a random middle as a sum
// of six cosines with zero velocity and acceleration at both ends, within 60 % of its velocity and
// 80 % of its acceleration limit. It has 100 waypoints over 10 s with velocities and accelerations,
// validated by validate(). Deterministic for seed and joint limits. `reach` in (0, 1]: share of
// each joint's range that the motion may use, around the middle. Throws std::runtime_error if
// validate() rejects it.
[[nodiscard]] TrajectoryPtr random_motion(const Cell& cell, ArmId arm, std::uint64_t seed,
                                          double reach);

// Returns the waypoints of `motion` with the deviation from its start scaled by `share`, starting
// at home; if `backwards`, from its goal to home. nullopt if that exceeds limits.
[[nodiscard]] std::optional<TrajectoryPtr> from_home(const Cell& cell, ArmId arm,
                                                     const Trajectory& motion, double share,
                                                     bool backwards);

// Motions that run together, each from its start at time zero; all other joints rest as in `rest`.
struct Motions {
  CellPtr cell;
  std::vector<TrajectoryPtr> trajectories;
  Configuration rest;

  // Sets q to the combined state with every motion at `progress` (at its goal after its end).
  void state_at(Duration progress, Configuration& q) const;
  // The same with the i-th motion ahead by `lead` (negative: behind).
  void state_at(Duration progress, std::size_t i, Duration lead, Configuration& q) const;
};

// Two motions over their common time, every `step`; the first motion leads or lags by any multiple
// of `step` up to `band`.
struct SampledBand {
  Duration step;
  Duration band{};
};
// Returns the smallest exact distance between different arms in that band, at most horizon_m. Stops
// early below `enough_m`.
[[nodiscard]] double closest_in_band(ExactScene& exact, const Motions& motions,
                                     const SampledBand& sampled, double horizon_m, double enough_m);

// Returns true if all motions, sampled every `step`, keep margin_m from objects and static links,
// and its share self_clearance_m / clearance_m from themselves. Different arms are not compared.
[[nodiscard]] bool clear_of_all_but_arms(ExactScene& exact, const Motions& motions, Duration step,
                                         double margin_m);

}  // namespace armloom::bench

#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/coordination/motion.h"
#include "test/bench/states.h"

namespace armloom::soundness {

// Uniform in [from, to), equal for all standard libraries.
[[nodiscard]] double uniform(std::mt19937_64& random, double from, double to);

// Returns a smooth motion of one arm: each joint oscillates around a random middle as a sum of six
// cosines, at rest at both ends, up to 90 % of its velocity and acceleration limits. `turn_rad`
// moves the first joint's middle. Waypoints every 0.1 s. Throws std::runtime_error if validate()
// rejects the motion.
[[nodiscard]] TrajectoryPtr swing(const Cell& cell, ArmId arm, Duration duration, double turn_rad,
                                  std::mt19937_64& random);

// Motions whose arm keeps clear of itself and of the scene (every 20 ms, exact shapes), so that
// verdicts are about pairs only. Half of them last 10 s, the others 2 to 10 s.
struct Pool {
  Pool(bench::ExactScene& exact, std::size_t count, std::uint64_t seed);

  std::vector<TrajectoryPtr> motions[2];  // by arm; those of even index turn to the right
  std::uint64_t refused = 0;
};

// A pair of motions. Each may be under way, start now or start later.
struct MovingPair {
  Motion candidate;
  Motion other;

  [[nodiscard]] Question question(const Cell& cell, const CheckMethod& method) const;
  // Returns the time until both motions have ended.
  [[nodiscard]] double span_s() const;
  // Sets q to the state `t` after the question's time. Each motion is `ahead` of its plan (s of
  // trajectory time), within its remaining range; other arms are at home.
  void state_at(double t_s, double ahead_candidate_s, double ahead_other_s, Configuration& q) const;
};

// Returns pairs that keep the cell's clearance at the question's time.
[[nodiscard]] std::vector<MovingPair> random_pairs(bench::ExactScene& exact, const Pool& pool,
                                                   std::size_t count, std::uint64_t seed);

}  // namespace armloom::soundness

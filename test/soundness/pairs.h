#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/coordination/motion.h"
#include "test/bench/states.h"

// Random pairs of timed motions of two arms, the attack on the certified check.
namespace armloom::soundness {

// Uniform in [from, to): the standard's distributions differ between libraries.
[[nodiscard]] double uniform(std::mt19937_64& random, double from, double to);

// A smooth motion of one arm over `duration`: each joint swings about a random middle as a sum of
// six cosines that begin and end at rest, as fast as 90 % of its velocity and acceleration limits;
// a waypoint every 0.1 s. `turn_rad` moves the middle of the arm's first joint. Through validate():
// std::runtime_error when that refuses it.
[[nodiscard]] TrajectoryPtr swing(const Cell& cell, ArmId arm, Duration duration, double turn_rad,
                                  std::mt19937_64& random);

// Motions of both arms of a cell that keep clear of themselves and of the scene (seen every 20 ms,
// by exact shapes), so that what a check says of a pair is about the two motions only. Half of them
// last 10 s, the others 2 to 10 s.
struct Pool {
  Pool(bench::ExactScene& exact, std::size_t count, std::uint64_t seed);

  std::vector<TrajectoryPtr> motions[2];  // by arm; even ones to its right, odd ones to its left
  std::uint64_t refused = 0;
};

// One motion beside another. Either may be under way already, start at once or only later.
struct MovingPair {
  Motion candidate;
  Motion other;

  [[nodiscard]] Question question(const Cell& cell, const CheckMethod& method) const;
  // How long anything still moves.
  [[nodiscard]] double span_s() const;
  // The two of them `t` after the question's instant, each `ahead` of its plan (seconds of
  // trajectory time), never behind where it is now nor outside of its motion; all others at home.
  void state_at(double t_s, double ahead_candidate_s, double ahead_other_s, Configuration& q) const;
};

// Pairs that keep the cell's clearance at the question's instant (others may part,
// OrientedDiagram).
[[nodiscard]] std::vector<MovingPair> random_pairs(bench::ExactScene& exact, const Pool& pool,
                                                   std::size_t count, std::uint64_t seed);

}  // namespace armloom::soundness

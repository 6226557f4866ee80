#include "test/soundness/band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "test/bench/cells.h"
#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

constexpr double kRounding_m = 1e-6;
constexpr double kHorizonOfAttack_m = 0.06;

// Pairs of motions for all methods. A pair in conflict is also checked with the candidate delayed
// until the pair is just free.
struct Scenery {
  Scenery()
      : exact(bench::two_pandas()),
        pool(exact, 40, 21),
        pairs(random_pairs(exact, pool, 400, 22)),
        checker(exact.scene) {}

  bench::ExactScene exact;
  Pool pool;
  std::vector<MovingPair> pairs;
  MotionChecker checker;
};

Scenery& scenery() {
  static Scenery made;
  return made;
}

TEST(BarelyFreePairs, KeepTheClearanceAtEverySampledInstant) {
  Scenery& s = scenery();
  const double clearance_m = s.exact.cell().clearances.clearance_m;
  TruthSampler sampler(s.exact);
  std::size_t found = 0;
  std::size_t tight = 0;
  for (const MovingPair& pair : s.pairs) {
    const Verdict regions = s.checker.judge(pair.question(s.exact.cell(), Coordinated{0.0}));
    const auto later = hardly_free(regions, pair);
    if (!later) continue;
    const Truth truth = sampler.of(*later);
    EXPECT_GE(truth.smallest_m, clearance_m - kRounding_m);
    ++found;
    tight += truth.smallest_m < clearance_m + kHorizonOfAttack_m / 2 ? 1 : 0;
  }
  std::cout << found << " hardly free, " << tight << " tight\n";
  EXPECT_GE(found, 10U);
  EXPECT_GE(tight, found / 2);
}

TEST(Swept, FreeMotionsKeepTheClearanceAtAnyProgress) {
  constexpr double kTracking_rad = 0.001;
  Scenery& s = scenery();
  const Cell& cell = s.exact.cell();
  std::mt19937_64 random(23);
  std::size_t free = 0;
  double closest_m = kHorizonOfAttack_m;
  for (const MovingPair& pair : s.pairs) {
    if (between_motions(s.checker.judge(pair.question(cell, Swept{kTracking_rad})))) continue;
    ++free;
    for (int again = 0; again < 4; ++again) {
      const Attack found = attack(s.exact, pair, kTracking_rad, kHorizonOfAttack_m, random);
      closest_m = std::min(closest_m, found.distance_m);
      EXPECT_GE(found.distance_m, cell.clearances.clearance_m - kRounding_m)
          << "at " << found.candidate_s << " and " << found.other_s << " s";
    }
  }
  std::cout << free << " free, closest " << closest_m << " m\n";
  EXPECT_GE(free, 40U);
  // An attack that never comes close proves nothing.
  EXPECT_LE(closest_m, cell.clearances.clearance_m + 0.004);
}

}  // namespace
}  // namespace armloom::soundness

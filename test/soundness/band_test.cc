#include "test/soundness/band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "test/bench/cells.h"
#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

using namespace std::chrono_literals;

constexpr double kRounding_m = 1e-6;
constexpr double kHorizonOfAttack_m = 0.06;

// One set of pairs for all methods; each is asked about as it is and, where that is a conflict,
// started just so late that it is free.
struct Scenery {
  Scenery()
      : exact(bench::two_pandas()),
        pool(exact, 40, 21),
        pairs(random_pairs(exact, pool, 400, 22)),
        arbiter(exact.scene) {}

  bench::ExactScene exact;
  Pool pool;
  std::vector<MovingPair> pairs;
  Arbiter arbiter;
};

Scenery& scenery() {
  static Scenery made;
  return made;
}

struct Outcome {
  std::size_t free = 0;
  std::size_t hardly_free = 0;
  double closest_m = kHorizonOfAttack_m;
};

// Attacks every pair that the method calls free.
Outcome attack_free_pairs(const CheckMethod& method, bool candidate_may_stand,
                          bool other_may_stand) {
  Scenery& s = scenery();
  const Cell& cell = s.exact.cell();
  std::mt19937_64 random(23);
  Outcome outcome;
  for (MovingPair pair : s.pairs) {
    pair.candidate.may_stand = candidate_may_stand;
    pair.other.may_stand = other_may_stand;
    const bool free = between_motions(s.arbiter.judge(pair.question(cell, method))) == nullptr;
    if (!free) {
      const auto later = hardly_free(s.arbiter, s.exact, pair, method);
      if (!later) continue;
      pair = *later;
    }
    ++(free ? outcome.free : outcome.hardly_free);
    const Attack found =
        attack(s.exact, pair, promise_of(cell, pair, method), kHorizonOfAttack_m, random);
    outcome.closest_m = std::min(outcome.closest_m, found.distance_m);
    EXPECT_GE(found.distance_m, cell.clearance_m - kRounding_m)
        << "at " << found.t_s << " s, ahead by " << found.ahead_candidate_s << " and "
        << found.ahead_other_s << " s";
  }
  return outcome;
}

// Each claim also says that the attack comes close: one that never does would prove nothing.
void expect_a_good_attack(const Outcome& outcome, double within_m) {
  std::cout << outcome.free << " free, " << outcome.hardly_free << " hardly free, closest "
            << outcome.closest_m << " m\n";
  EXPECT_GE(outcome.free + outcome.hardly_free, 40U);
  EXPECT_GE(outcome.hardly_free, 10U);
  EXPECT_LE(outcome.closest_m, scenery().exact.cell().clearance_m + within_m);
}

TEST(HardlyFree, PairsKeepTheClearanceAtEverySampledInstant) {
  Scenery& s = scenery();
  TruthSampler sampler(s.exact);
  std::size_t found = 0;
  std::size_t tight = 0;
  for (const MovingPair& pair : s.pairs) {
    const auto later = hardly_free(s.arbiter, s.exact, pair, Certified{0ms, false, 0.0});
    if (!later) continue;
    const Truth truth = sampler.of(*later);
    EXPECT_GE(truth.smallest_m, s.exact.cell().clearance_m - kRounding_m);
    ++found;
    tight += truth.smallest_m < s.exact.cell().clearance_m + 0.001 ? 1 : 0;
  }
  EXPECT_GE(found, 10U);
  EXPECT_GE(tight, 9 * found / 10);
}

TEST(Band, FreePairsKeepTheClearanceWhateverTheDelay) {
  expect_a_good_attack(attack_free_pairs(Certified{100ms, false, 0.0}, false, false), 0.001);
}

TEST(Band, FreePairsKeepTheClearanceWithJointsOffTheirPaths) {
  expect_a_good_attack(attack_free_pairs(Certified{0ms, false, 0.01}, false, false), 0.03);
}

TEST(Band, FreePairsKeepTheClearanceWhereverTheyStop) {
  expect_a_good_attack(attack_free_pairs(Certified{0ms, true, 0.0}, false, false), 0.001);
}

TEST(Band, FreePairsKeepTheClearanceWithDelayStopAndDeviationTogether) {
  expect_a_good_attack(attack_free_pairs(Certified{100ms, true, 0.001}, false, false), 0.004);
}

TEST(Band, AMotionThatMayStandMayStandAnywhereBehindItsPlan) {
  expect_a_good_attack(attack_free_pairs(Certified{50ms, true, 0.001}, true, false), 0.004);
  expect_a_good_attack(attack_free_pairs(Certified{50ms, true, 0.001}, false, true), 0.004);
}

TEST(Band, SweptMotionsKeepTheClearanceInAnyCombinationOfPlaces) {
  expect_a_good_attack(attack_free_pairs(Swept{0.001}, false, false), 0.004);
}

}  // namespace
}  // namespace armloom::soundness

// Proof by chaos: even a scheduler without rules cannot drive one arm into another.
#include "test/guard/chaos.h"

#include <gtest/gtest.h>

#include <iostream>

#include "test/scenarios/seeds.h"

namespace armloom {
namespace {

constexpr int kSteps = 60;
constexpr std::uint64_t kRuns = 4000;  // 100,000 with test/run --deep

struct Tally {
  std::uint64_t runs = 0, contacts = 0, too_close = 0;
  std::size_t grants = 0, refusals = 0, advances = 0;
};

Tally run_all(bool guarded, std::uint64_t runs) {
  Tally tally;
  for (const std::size_t arms : {2U, 3U, 4U}) {
    const RailCell rails(arms);
    MotionChecker checker(rails.scene);
    for (std::uint64_t seed = 1; seed <= runs / 3; ++seed) {
      const Chaos::Outcome one = Chaos(rails, checker, seed * 4 + arms, guarded).run(kSteps);
      ++tally.runs;
      tally.contacts += one.closest_m <= 0.0 ? 1 : 0;
      tally.too_close += one.closest_m < RailCell::kClearance_m ? 1 : 0;
      tally.grants += one.grants;
      tally.refusals += one.refusals;
      tally.advances += one.advances;
      if (guarded) {
        EXPECT_GE(one.closest_m, RailCell::kClearance_m)
            << arms << " arms, seed " << seed * 4 + arms;
      }
    }
  }
  std::cout << (guarded ? "with" : "without") << " the guard: " << tally.runs << " runs, "
            << tally.grants << " grants, " << tally.refusals << " refusals, " << tally.advances
            << " advances; " << tally.contacts << " runs with contact, " << tally.too_close
            << " closer than the clearance\n";
  return tally;
}

TEST(Chaos, GuardKeepsTheClearance) {
  const std::uint64_t runs = seed_count(kRuns);
  const Tally tally = run_all(true, runs);
  EXPECT_EQ(tally.too_close, 0U);
  if (runs < 300) return;
  EXPECT_GT(tally.grants, 5 * tally.runs) << "the guard must grant some requests";
  EXPECT_GT(tally.refusals, tally.runs) << "and refuse others";
}

TEST(Chaos, WithoutTheGuardArmsTouch) {
  const Tally tally = run_all(false, std::max<std::uint64_t>(300, seed_count(kRuns, 10)));
  EXPECT_GT(tally.contacts, tally.runs / 10);
}

}  // namespace
}  // namespace armloom

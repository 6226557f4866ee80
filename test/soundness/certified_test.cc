#include <gtest/gtest.h>

#include "test/bench/cells.h"
#include "test/soundness/soundness.h"

namespace armloom::soundness {
namespace {

const Report& report() {
  static const Report made = measure(300, 6, {0.1, 0.05, 0.01, 0.001});
  return made;
}

TEST(Truth, SkippingSamplesDoesNotChangeTheResult) {
  bench::ExactScene exact(bench::two_pandas());
  const Pool pool(exact, 6, 11);
  TruthSampler sampler(exact);
  std::size_t below = 0;
  for (const MovingPair& pair : random_pairs(exact, pool, 12, 13)) {
    const Truth skipped = sampler.of(pair);
    const Truth all = sampler.of_every_sample(pair);
    EXPECT_NEAR(skipped.smallest_m, all.smallest_m, 1e-6);
    EXPECT_EQ(skipped.first_below_s, all.first_below_s);
    EXPECT_LT(skipped.looked_at, all.looked_at / 4);
    below += all.first_below_s ? 1 : 0;
  }
  EXPECT_GE(below, 1U);
}

TEST(CertifiedCheck, SampledPairsIncludeCollisionsAndNearMisses) {
  const double collide = static_cast<double>(report().colliding) / 300.0;
  EXPECT_GE(collide, 0.07);
  EXPECT_LE(collide, 0.20);
  EXPECT_GE(report().close, 40U);
}

TEST(CertifiedCheck, MissesNoPairCloserThanTheClearance) {
  EXPECT_EQ(report().missed, 0U);
  EXPECT_EQ(report().missed_collisions, 0U);
  for (const std::string& failure : report().failures) ADD_FAILURE() << failure;
}

TEST(CertifiedCheck, RaisesFewFalseAlarms) { EXPECT_LE(report().false_alarm_share(), 0.05); }

TEST(DiscreteCheck, MissesCollisionsThatTheCertifiedCheckFinds) {
  const Report& r = report();
  ASSERT_EQ(r.discrete.size(), 4U);
  EXPECT_GE(r.discrete[0].without.pairs, 1U);
  for (std::size_t i = 1; i < r.discrete.size(); ++i) {
    EXPECT_LE(r.discrete[i].without.pairs, r.discrete[0].without.pairs);
  }
}

}  // namespace
}  // namespace armloom::soundness

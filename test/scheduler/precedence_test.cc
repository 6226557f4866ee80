#include <gtest/gtest.h>

#include "test/scheduler/passing_words.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

using test::kA;
using test::kB;
using test::kC;
using test::kNext;
using test::motion;
using test::predicted;
using test::region;

TEST(Precedence, LimitsTheSecondToTheNearestOccupiedBox) {
  const Precedence order(kA, kB, region({{1s, 2s, 4s, 6s}, {2s, 3s, 3s, 5s}, {3s, 4s, 5s, 7s}}),
                         true);
  EXPECT_EQ(order.limit(0s), 3s - kShortOf);
  EXPECT_EQ(order.limit(2900ms), 3s - kShortOf);
  EXPECT_EQ(order.limit(3s), 5s - kShortOf);
  EXPECT_EQ(order.limit(3999ms), 5s - kShortOf);
  EXPECT_EQ(order.limit(4s), std::nullopt);
}

TEST(Precedence, ReversedOrderSwapsTheTimes) {
  const Precedence order(kA, kB, region({{1s, 2s, 4s, 6s}}), false);
  EXPECT_EQ(order.first(), kB);
  EXPECT_EQ(order.limit(5s), 1s - kShortOf);
  EXPECT_EQ(order.limit(6s), std::nullopt);
  EXPECT_EQ(order.region().proximity.body_a, "b");
  EXPECT_EQ(order.region().time_a, 2s);
}

TEST(Prediction, WaitCostsTheTimeUntilTheFirstLeavesPlusAPause) {
  const Precedence order(kA, kB, region({{1s, 3s, 2s, 4s}}), true);
  const auto ends = predicted({motion(kA, 0, 5s), motion(kB, 1, 5s)}, {{0, 1, &order}}).ends;
  EXPECT_EQ(ends[0], 5s);
  EXPECT_EQ(ends[1], 5s + 1s + kShortOf + kPauseLoss);
}

TEST(Prediction, MotionThatArrivesLaterDoesNotWait) {
  const Precedence order(kA, kB, region({{1s, 2s - kShortOf, 2s, 4s}}), true);
  EXPECT_EQ(predicted({motion(kA, 0, 5s), motion(kB, 1, 5s)}, {{0, 1, &order}}).ends[1], 5s);
}

TEST(Prediction, ReportsTheCycleThatIsStuck) {
  const Precedence ab(kA, kB, region({{2s, 3s, 1s, 4s}}), true);
  const Precedence bc(kB, kC, region({{2s, 3s, 1s, 4s}}), true);
  const Precedence ca(kC, kA, region({{2s, 3s, 1s, 4s}}), true);
  const std::vector<CoordinatedMotion> motions{motion(kA, 0, 5s), motion(kB, 1, 5s),
                                               motion(kC, 2, 5s)};
  EXPECT_TRUE(predicted(motions, {{0, 1, &ab}, {1, 2, &bc}}).stuck.empty());
  const Prediction stuck = predicted(motions, {{0, 1, &ab}, {1, 2, &bc}, {2, 0, &ca}});
  EXPECT_EQ(stuck.stuck, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(stuck.ring.size(), 3U);
}

TEST(Prediction, MotionStartsWhenItsPredecessorHasEnded) {
  std::vector<CoordinatedMotion> motions{motion(kA, 0, 5s), motion(kNext, 0, 2s)};
  motions[0].progress = 1s;
  EXPECT_EQ(predicted(motions, {}).ends[1], 6s);
  motions[0].outlook.pace = 1.5;
  EXPECT_EQ(predicted(motions, {}).ends[1], 8s);
}

}  // namespace
}  // namespace armloom

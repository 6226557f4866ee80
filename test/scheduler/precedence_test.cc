#include <gtest/gtest.h>

#include "test/scheduler/passing_words.h"

namespace armloom {
namespace {

constexpr std::size_t kBehindFirst[] = {0};

using namespace std::chrono_literals;

using test::kA;
using test::kB;
using test::kC;
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
  const auto ends = predict({{0s, 5s}, {0s, 5s}}, {{0, 1, &order}}).ends;
  EXPECT_EQ(ends[0], 5s);
  EXPECT_EQ(ends[1], 5s + 1s + kShortOf + kPauseLoss);
}

TEST(Prediction, MotionThatArrivesLaterDoesNotWait) {
  const Precedence order(kA, kB, region({{1s, 2s - kShortOf, 2s, 4s}}), true);
  EXPECT_EQ(predict({{0s, 5s}, {0s, 5s}}, {{0, 1, &order}}).ends[1], 5s);
}

TEST(Prediction, ReportsTheCycleThatIsStuck) {
  const Precedence ab(kA, kB, region({{2s, 3s, 1s, 4s}}), true);
  const Precedence bc(kB, kC, region({{2s, 3s, 1s, 4s}}), true);
  const Precedence ca(kC, kA, region({{2s, 3s, 1s, 4s}}), true);
  const std::vector<MotionAhead> motions(3, {0s, 5s});
  EXPECT_TRUE(predict(motions, {{0, 1, &ab}, {1, 2, &bc}}).stuck.empty());
  const Prediction stuck = predict(motions, {{0, 1, &ab}, {1, 2, &bc}, {2, 0, &ca}});
  EXPECT_EQ(stuck.stuck, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(stuck.ring.size(), 3U);
}

TEST(Prediction, MotionStartsWhenItsPredecessorHasEnded) {
  EXPECT_EQ(predict({{1s, 5s}, {0s, 2s, kBehindFirst}}, {}).ends[1], 6s);
  const MotionAhead slow{.progress = 1s, .duration = 5s, .pace = 1.5};
  EXPECT_EQ(predict({slow, {0s, 2s, kBehindFirst}}, {}).ends[1], 8s);
}

}  // namespace
}  // namespace armloom

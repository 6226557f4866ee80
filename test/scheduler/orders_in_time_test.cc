#include <gmock/gmock.h>

#include "core/precedence/motion_chains.h"
#include "core/precedence/precedence_graph.h"
#include "test/scheduler/bench_cell.h"
#include "test/scheduler/passing_words.h"

namespace armloom {
namespace {

using test::kA;
using test::kB;
using test::kC;
using test::kNext;
using test::motion;
using test::predicted;
using ::testing::ElementsAre;

struct OrdersInTime : ::testing::Test {
  PrecedenceGraph graph{4};

  PassingOrders decide(const CoordinatedMotion& candidate, const std::vector<PairRegions>& regions,
                       std::optional<Duration> latest = std::nullopt) const {
    const std::vector<CoordinatedMotion> candidates{candidate};
    return orders_in_time(graph.question(candidates, regions), latest);
  }
  PassingOrders admit(const CoordinatedMotion& candidate, const std::vector<PairRegions>& regions,
                      std::optional<Duration> latest = std::nullopt) {
    PassingOrders orders = decide(candidate, regions, latest);
    if (orders.blockers.empty()) graph.admit({candidate}, orders);
    return orders;
  }
};

// B meets A from 1 to 2 s of B's motion. A is in that region from 4 to 6 s of its own motion.
const std::vector<PairRegions> kMeet{{kB, kA, {region(ProgressBox{1s, 2s, 4s, 6s})}}};

TEST_F(OrdersInTime, MotionThatLeavesInTimePassesFirst) {
  admit(motion(kA, 0, 10s), {});
  const auto orders = admit(motion(kB, 1, 3s), kMeet);
  ASSERT_THAT(orders.blockers, ::testing::IsEmpty());
  EXPECT_EQ(orders.precedences.front().first(), kB);
  EXPECT_THAT(orders.prediction.begins, ElementsAre(0s, 0s));
  EXPECT_EQ(graph.limit(kA), 4s - kShortOf);
  EXPECT_EQ(graph.limit(kB), 3s);
}

TEST_F(OrdersInTime, LateMotionStartsLaterToPassSecondWithoutStopping) {
  admit(motion(kA, 0, 10s), {});
  graph.progress(kA, 3s);  // arrives in 1 s, has left in 3 s
  const auto orders = admit(motion(kB, 1, 3s), kMeet);
  ASSERT_THAT(orders.blockers, ::testing::IsEmpty());
  EXPECT_EQ(orders.precedences.front().first(), kA);
  EXPECT_EQ(orders.prediction.begins.back(), 2s + kShortOf) << "and 1 s to just before the region";
  EXPECT_EQ(orders.prediction.ends.back(), 5s + kShortOf);
}

TEST_F(OrdersInTime, WaitsForProgressNotForTheClock) {
  admit(motion(kA, 0, 10s), {});
  graph.progress(kA, 3s);
  admit(motion(kB, 1, 3s), kMeet);
  graph.progress(kA, 5s + kShortOf - 1ms);  // whatever time that took
  EXPECT_EQ(graph.limit(kB), 0s);
  EXPECT_EQ(graph.held_back(kB)->other, kA);
  graph.progress(kA, 5s + kShortOf);
  EXPECT_EQ(graph.limit(kB), 1s - kShortOf) << "starts, up to the region in which A still is";
  graph.progress(kA, 6s);
  EXPECT_EQ(graph.limit(kB), 3s);
}

TEST_F(OrdersInTime, RejectsStartsAfterLatest) {
  admit(motion(kA, 0, 10s), {});
  graph.progress(kA, 3s);
  EXPECT_THAT(decide(motion(kB, 1, 3s), kMeet, 2s).blockers, ::testing::IsEmpty());
  for (const Duration latest : {Duration{}, Duration(2s) - Duration(1)}) {
    const auto refused = decide(motion(kB, 1, 3s), kMeet, latest);
    ASSERT_EQ(refused.blockers.size(), 1u);
    EXPECT_EQ(refused.blockers[0].blocked, kB);
    EXPECT_EQ(refused.blockers[0].other, kA);
  }
}

// With `latest` zero both motions start now. If the second would arrive just when the first leaves,
// the second waits kShortOf at its start.
TEST_F(OrdersInTime, MotionThatArrivesLaterStartsNow) {
  for (const Duration comes : {Duration(6s), 6s + kShortOf}) {
    graph = PrecedenceGraph(4);
    admit(motion(kA, 0, 10s), {});
    const ConflictRegion meet = region(ProgressBox{comes, 7s, 4s, 6s});
    const auto orders = admit(motion(kB, 1, 10s), {{kB, kA, {meet}}}, Duration{});
    ASSERT_THAT(orders.blockers, ::testing::IsEmpty());
    if (comes == 6s) {
      EXPECT_EQ(graph.limit(kB), 0s);
      EXPECT_EQ(orders.prediction.begins.back(), kShortOf);
      graph.progress(kA, kShortOf);
    }
    EXPECT_EQ(graph.limit(kB), comes - kShortOf) << "it starts";
    EXPECT_EQ(orders.prediction.ends.back(), comes == 6s ? 10s + kShortOf : 10s);
  }
}

TEST_F(OrdersInTime, ChoosesTheSmallestDelayThatPassesAllRegions) {
  admit(motion(kA, 0, 10s), {});
  admit(motion(kC, 2, 10s), {});
  // A is in the region from 2 to 3 s, C from 6 to 8 s. B fits in between.
  const auto orders = admit(
      motion(kB, 1, 2s),
      {{kB, kA, {region(ProgressBox{500ms, 1500ms, 2s, 3s})}},
       {kB,
        kC,
        {region(ProgressBox{500ms, 1500ms, 1s, 2s}), region(ProgressBox{500ms, 1500ms, 6s, 8s})}}});
  ASSERT_THAT(orders.blockers, ::testing::IsEmpty());
  EXPECT_EQ(orders.prediction.begins.back(), 2500ms + kShortOf);
  EXPECT_EQ(graph.limit(kC), 6s - kShortOf) << "behind B";
  EXPECT_EQ(graph.limit(kA), 10s) << "before B";
  EXPECT_EQ(graph.limit(kB), 0s);
  graph.progress(kA, 2500ms + kShortOf);
  EXPECT_EQ(graph.limit(kB), 0s) << "C has not gone from its first place";
  graph.progress(kC, 2s);
  EXPECT_EQ(graph.limit(kB), 500ms - kShortOf);
}

TEST_F(OrdersInTime, LaterMotionPassesAGoalBeforeItsArmArrives) {
  admit(motion(kA, 0, 4s), {});
  admit(motion(kB, 1, 2s), {{kB, kA, {region(ProgressBox{0s, 1s, 3s, 4s - 1ms})}}});
  ASSERT_EQ(graph.limit(kB), 2s) << "it leaves before A arrives";
  // C meets B's goal, where B ends: C passes before B arrives.
  const auto orders =
      admit(motion(kC, 2, 1s), {{kC, kB, {region(ProgressBox{0s, 500ms, 1s, 2s})}}});
  ASSERT_THAT(orders.blockers, ::testing::IsEmpty());
  EXPECT_EQ(graph.limit(kB), 1s - kShortOf);
}

TEST_F(OrdersInTime, MotionThatEndsInTheWayBlocksAndIsReported) {
  admit(motion(kA, 0, 5s), {});
  const auto refused =
      decide(motion(kB, 1, 3s), {{kB, kA, {region(ProgressBox{1s, 2s, 500ms, 5s})}}});
  ASSERT_EQ(refused.blockers.size(), 1u);
  EXPECT_EQ(refused.blockers[0].other, kA);
  EXPECT_THAT(refused.in_the_way, ElementsAre(ArmId{0}));
}

TEST_F(OrdersInTime, KeepsExistingOrders) {
  admit(motion(kA, 0, 10s), {});
  admit(motion(kB, 1, 3s), kMeet);
  const auto orders =
      admit(motion(kC, 2, 3s), {{kC, kB, {region(ProgressBox{1s, 2s, 2500ms, 2800ms})}}});
  ASSERT_EQ(orders.precedences.size(), 2u);
  EXPECT_EQ(orders.precedences.front().first(), kB);
  EXPECT_EQ(orders.precedences.front().second(), kA);
}

TEST_F(OrdersInTime, ArmAtRestInTheWayBlocks) {
  const auto refused =
      decide(motion(kA, 0, 5s), {{kA, ArmId{2}, {region(ProgressBox{2s, 3s, 0s, 0s})}}});
  ASSERT_EQ(refused.blockers.size(), 1u);
  EXPECT_EQ(refused.blockers[0].arm, ArmId{2});
}

// ---- Start conditions ----

TEST(Precedence, ReleasesTheStartWhenTheSecondCanPassWithoutStopping) {
  const ConflictRegion two =
      // A must be 2 s ahead of B, then 3 s
      region(ProgressBox{1s, 4s, 2s, 3s}, ProgressBox{4s, 7s, 4s, 5s});
  const Precedence order(kA, kB, two, true, true);
  EXPECT_EQ(order.limit(0s), 0s);
  EXPECT_EQ(order.limit(3s + kShortOf - 1ns), 0s);
  EXPECT_EQ(order.limit(3s + kShortOf), 2s - kShortOf)
      << "starts 1 s before A has left the first box";
  EXPECT_EQ(order.limit(4s), 4s - kShortOf);
  EXPECT_EQ(order.limit(7s), std::nullopt);
}

TEST(Precedence, DoesNotDelayAStartIfTheSecondArrivesLater) {
  const ConflictRegion late = region(ProgressBox{1s, 2s, 3s, 4s});
  const Precedence order(kA, kB, late, true, true);
  EXPECT_EQ(order.limit(0s), 3s - kShortOf);
}

// ---- orders_apart() ----

TEST_F(OrdersInTime, OrdersApartAdmitsOnlyMotionsWithoutRegions) {
  graph.admit({motion(kA, 0, 10s)}, {});
  const std::vector<CoordinatedMotion> b{motion(kB, 1, 3s)}, c{motion(kC, 2, 3s)};
  const std::vector<PairRegions> none;
  const auto refused = orders_apart(graph.question(b, kMeet));
  ASSERT_EQ(refused.blockers.size(), 1u);
  EXPECT_EQ(refused.blockers[0].other, kA);
  EXPECT_THAT(orders_apart(graph.question(c, none)).blockers, ::testing::IsEmpty());
  graph.progress(kA, 6s + 1ns);
  EXPECT_THAT(orders_apart(graph.question(b, kMeet)).blockers, ::testing::IsEmpty()) << "passed";
}

// ---- Prediction and chains ----

TEST(Prediction, ReturnsWhenAMotionReachesAProgress) {
  const Precedence order(kA, kB, region(ProgressBox{1s, 3s, 2s, 4s}), true);
  std::vector<CoordinatedMotion> motions{motion(kA, 0, 5s), motion(kB, 1, 5s),
                                         motion(kNext, 0, 2s)};
  motions[0].progress = 1s;
  const Prediction p = predicted(motions, {{0, 1, &order}});
  EXPECT_EQ(p.comes_to(0, 500ms), Duration{}) << "already passed";
  EXPECT_EQ(p.comes_to(0, 3s), Duration(2s));
  EXPECT_EQ(p.comes_to(1, 2s), Duration(2s) + kShortOf + kPauseLoss) << "waits just before it";
  EXPECT_EQ(p.comes_to(2, 1s), Duration(5s)) << "behind A in its arm queue";
  EXPECT_EQ(p.comes_to(0, 6s), std::nullopt) << "beyond its end";
}

TEST(Prediction, ReturnsNulloptForStuckMotions) {
  const Precedence ab(kA, kB, region(ProgressBox{2s, 3s, 1s, 4s}), true);
  const Precedence ba(kB, kA, region(ProgressBox{2s, 3s, 1s, 4s}), true);
  const Prediction p = predicted({motion(kA, 0, 5s), motion(kB, 1, 5s), motion(kNext, 0, 1s)},
                                 {{0, 1, &ab}, {1, 0, &ba}});
  EXPECT_THAT(p.stuck, ElementsAre(0u, 1u, 2u));
  EXPECT_EQ(p.comes_to(2, 0s), std::nullopt) << "it never starts";
}

TEST(MotionChains, LinkSuccessiveMotionsOfTheSameArm) {
  const CoordinatedMotion team{.step = kC, .arms = {ArmId{0}, ArmId{1}}, .duration = 1s};
  const MotionChains chains({motion(kA, 0, 1s), motion(kB, 1, 1s), team, motion(kNext, 0, 1s)});
  EXPECT_THAT(chains.before(0), ElementsAre());
  EXPECT_THAT(chains.before(1), ElementsAre());
  EXPECT_THAT(chains.before(2), ElementsAre(0u, 1u));
  EXPECT_THAT(chains.before(3), ElementsAre(2u));
}

// ---- Arms that no motion takes away ----

TEST(RestingFor, ReturnsArmsWithoutANextMotion) {
  const CoordinatedMotion team{.step = kC, .arms = {ArmId{0}, ArmId{1}}, .duration = 1s};
  const std::vector<CoordinatedMotion> motions{motion(kA, 0, 1s), team, motion(kB, 2, 1s),
                                               motion(kNext, 0, 1s)};
  EXPECT_THAT(resting_for(motions, motions[0].arms, 0, 2), ElementsAre());
  EXPECT_THAT(resting_for(motions, team.arms, 1, 2), ElementsAre(ArmId{1}));
}

TEST(RestingFor, ReturnsArmsWhoseNextMotionFollowsTheOtherMotion) {
  const CoordinatedMotion team{.step = kC, .arms = {ArmId{0}, ArmId{1}}, .duration = 1s};
  const auto behind = {motion(kA, 0, 1s), motion(kB, 1, 1s), team};
  EXPECT_THAT(resting_for(behind, {ArmId{0}}, 0, 1), ElementsAre(ArmId{0}));
  const auto ahead = {motion(kA, 0, 1s), team, motion(kB, 1, 1s)};
  EXPECT_THAT(resting_for(ahead, {ArmId{0}}, 0, 2), ElementsAre());
}

}  // namespace
}  // namespace armloom

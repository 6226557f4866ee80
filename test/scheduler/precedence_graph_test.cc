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
using test::region;

struct Graph : ::testing::Test {
  PrecedenceGraph graph{3};
  PassingOrders admit(const std::vector<CoordinatedMotion>& candidates,
                      const std::vector<PairRegions>& regions) {
    PassingOrders orders = cheapest_orders(graph.question(candidates, regions));
    if (orders.blockers.empty()) graph.admit(candidates, orders);
    return orders;
  }
  // B passes A's goal after Next has moved the arm away.
  void let_b_wait_until_next_has_left() {
    admit({motion(kA, 0, 5s)}, {});
    graph.granted(kA, 5s);
    admit({motion(kB, 1, 5s), motion(kNext, 0, 4s)},
          {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}, {kB, kNext, {region({{2s, 3s, 0s, 1s}})}}});
  }
};

TEST_F(Graph, CandidatePassesFirstIfCheaper) {
  admit({motion(kA, 0, 10s)}, {});
  // Waiting for A would cost B 7 s.
  admit({motion(kB, 1, 3s)}, {{kB, kA, {region({{1s, 2s, 6s, 8s}})}}});
  EXPECT_EQ(graph.limit(kB), 3s);
  EXPECT_EQ(graph.limit(kA), 6s - kShortOf);
  graph.progress(kB, 2s);
  EXPECT_EQ(graph.limit(kA), 10s);
}

TEST_F(Graph, MotionWithAuthorityInTheRegionIsNotOvertaken) {
  admit({motion(kA, 0, 10s)}, {});
  graph.granted(kA, 7s);
  admit({motion(kB, 1, 3s)}, {{kB, kA, {region({{1s, 2s, 6s, 8s}})}}});
  EXPECT_EQ(graph.limit(kA), 10s);
  EXPECT_EQ(graph.limit(kB), 0s) << "waiting at the start costs less than stopping on the path";
  EXPECT_EQ(graph.held_back(kB)->other, kA);
  EXPECT_EQ(graph.held_back(kB)->proximity.body_a, "a");
}

TEST_F(Graph, GoalInTheWayIsPassedBeforeItIsReached) {
  admit({motion(kA, 0, 5s)}, {});
  const auto orders = admit({motion(kB, 1, 5s)}, {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}});
  ASSERT_TRUE(orders.blockers.empty());
  EXPECT_EQ(graph.limit(kA), 4s - kShortOf);
  EXPECT_EQ(graph.limit(kB), 5s);
}

TEST_F(Graph, ArmAtRestInTheWayBlocks) {
  const auto orders = admit({motion(kA, 0, 5s)}, {{kA, ArmId{2}, {region({{2s, 3s, 0s, 0s}})}}});
  ASSERT_EQ(orders.blockers.size(), 1U);
  EXPECT_EQ(orders.blockers[0].arm, ArmId{2});
  EXPECT_EQ(orders.in_the_way, std::vector<ArmId>{ArmId{2}});
}

// A ends at B's start, and B ends at A's start.
const std::vector<PairRegions> kSwap{
    {kA, kB, {region({{4s, 5s, 0s, 2s}}), region({{0s, 1s, 3s, 5s}})}}};

TEST_F(Graph, SwapSucceedsIfThereIsRoomToPass) {
  const auto orders = admit({motion(kA, 0, 5s), motion(kB, 1, 5s)}, kSwap);
  ASSERT_TRUE(orders.blockers.empty());
  EXPECT_EQ(graph.limit(kA), 4s - kShortOf);
  EXPECT_EQ(graph.limit(kB), 3s - kShortOf);
}

TEST_F(Graph, SwapWithoutRoomIsACycle) {
  const auto orders = admit({motion(kA, 0, 5s), motion(kB, 1, 5s)},
                            {{kA, kB, {region({{2s, 5s, 0s, 3s}}), region({{0s, 3s, 2s, 5s}})}}});
  ASSERT_FALSE(orders.blockers.empty());
  EXPECT_EQ(orders.blockers[0].blocked, kA);
  EXPECT_EQ(orders.blockers[0].other, kB);
}

// A's first motion comes to rest in B's way; its next motion leaves.
TEST_F(Graph, MotionWaitsUntilTheNextMotionHasLeftARest) {
  admit({motion(kA, 0, 5s)}, {});
  graph.granted(kA, 5s);
  EXPECT_FALSE(
      admit({motion(kB, 1, 5s)}, {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}}).blockers.empty());
  const auto orders =
      admit({motion(kB, 1, 5s), motion(kNext, 0, 4s)},
            {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}, {kB, kNext, {region({{2s, 3s, 0s, 1s}})}}});
  ASSERT_TRUE(orders.blockers.empty());
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  graph.progress(kA, 5s);
  graph.finish(kA);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf) << "the arm still rests there";
  graph.progress(kNext, 1s);
  EXPECT_EQ(graph.limit(kB), 5s);
}

TEST_F(Graph, AbandonedMotionBlocksOnlyMotionsThatPassItsRest) {
  admit({motion(kA, 0, 5s)}, {});
  graph.granted(kA, 2s);
  admit({motion(kB, 1, 5s)}, {{kB, kA, {region({{2s, 3s, 1s, 4s}})}}});
  admit({motion(kC, 2, 5s)}, {{kC, kA, {region({{2s, 3s, 3s, 4s}})}}});
  graph.progress(kA, 2s);
  graph.abandon(kA, 2s);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  EXPECT_EQ(graph.held_back(kB)->arm, ArmId{0});
  EXPECT_EQ(graph.limit(kC), 5s);
  admit({motion(kNext, 0, 1s)}, {{kNext, kB, {region({{0s, 500ms, 2s, 3s}})}}});
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  graph.progress(kNext, 500ms);
  EXPECT_EQ(graph.limit(kB), 5s);
}

TEST_F(Graph, AbandonedMotionBlocksOnlyTheBoxesThatItHasNotLeft) {
  admit({motion(kA, 0, 5s)}, {});
  graph.granted(kA, 5s);
  admit({motion(kB, 1, 5s)}, {{kB, kA, {region({{1s, 2s, 1s, 2s}, {3s, 4s, 2s, 3s}})}}});
  graph.progress(kA, 2500ms);
  graph.abandon(kA, 2500ms);
  EXPECT_EQ(graph.limit(kB), 3s - kShortOf);
}

// B would pass without a wait after A has ended and before Next begins. But the arm rests there.
TEST_F(Graph, RegionsThatMeetAtARestShareOneOrder) {
  admit({motion(kA, 0, 5s)}, {});
  const auto orders = admit({motion(kB, 1, 6s), motion(kNext, 0, 20s)},
                            {{kB, kA, {region({{5200ms, 5400ms, 4s, 5s}})}},
                             {kB, kNext, {region({{5200ms, 5400ms, 0s, 10s}})}}});
  ASSERT_EQ(orders.precedences.size(), 2u);
  EXPECT_EQ(orders.precedences[0].first() == kB, orders.precedences[1].first() == kB);
}

TEST_F(Graph, CancelingTheNextMotionKeepsTheGoalBlocked) {
  let_b_wait_until_next_has_left();
  graph.abandon(kNext, 0s);
  graph.progress(kA, 5s);
  graph.finish(kA);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  EXPECT_EQ(graph.held_back(kB)->arm, ArmId{0});
}

// B must wait until Next has left A's goal, but A never arrives at this goal.
TEST_F(Graph, UnreachedGoalOfAnAbandonedMotionBlocksNothing) {
  let_b_wait_until_next_has_left();
  graph.progress(kA, 2s);
  graph.abandon(kNext, 0s);
  ASSERT_EQ(graph.limit(kB), 2s - kShortOf);
  graph.abandon(kA, 3s);
  EXPECT_EQ(graph.limit(kB), 5s);
}

TEST_F(Graph, LargerPriorityPassesFirst) {
  admit({motion(kA, 0, 3s)}, {});
  CoordinatedMotion urgent = motion(kB, 1, 9s);
  urgent.priority = 1;
  admit({urgent}, {{kB, kA, {region({{5s, 8s, 1s, 2s}})}}});
  EXPECT_EQ(graph.limit(kA), 3s) << "it has left long before";
  CoordinatedMotion more = motion(kC, 2, 3s);
  more.priority = 2;
  admit({more}, {{kC, kB, {region({{1s, 2s, 500ms, 9s}})}}});
  EXPECT_EQ(graph.limit(kB), 0s) << "waiting at the start costs less than stopping on the path";
}

TEST_F(Graph, MotionThatKeepsItsPlaceIsNotOvertaken) {
  admit({motion(kA, 0, 10s)}, {});
  graph.set_outlook(kA, {.keeps_its_place = true});
  admit({motion(kB, 1, 3s)}, {{kB, kA, {region({{1s, 2s, 6s, 8s}})}}});
  EXPECT_EQ(graph.limit(kA), 10s);
  EXPECT_EQ(graph.limit(kB), 0s) << "waiting at the start costs less than stopping on the path";
}

// Later motions than Next do not matter.
TEST_F(Graph, AbandonedMotionBlocksOnlyTheStartItShouldHaveLeft) {
  const std::vector<PairRegions> regions = {{kA, kB, {region({{4s, 5s, 2s, 3s}})}},
                                            {kNext, kB, {region({{0s, 1s, 2s, 3s}})}}};
  for (const StepId abandoned : {kC, kNext}) {
    graph = PrecedenceGraph(3);
    admit({motion(kA, 0, 5s)}, {});
    graph.granted(kA, 5s);
    admit({motion(kB, 1, 5s), motion(kNext, 0, 5s), motion(kC, 0, 5s)}, regions);
    graph.abandon(kC, 0s);
    if (abandoned == kNext) graph.abandon(kNext, 0s);
    graph.progress(kA, 5s);
    graph.finish(kA);
    graph.progress(kNext, 2s);
    EXPECT_EQ(graph.limit(kB), abandoned == kC ? 5s : 2s - kShortOf);
  }
}

// A moves two arms. One of them is then at the start of B, the other at the start of Next. A and B
// have no region.
TEST_F(Graph, ArmLeftByATeamBlocksTheTeamsOtherArm) {
  CoordinatedMotion team = motion(kA, 0, 5s);
  team.arms.push_back(ArmId{1});
  admit({team}, {});
  admit({motion(kNext, 1, 5s), motion(kB, 0, 5s)}, {{kNext, kB, {region({{0s, 1s, 2s, 3s}})}}});
  graph.abandon(kNext, 0s);
  graph.progress(kA, 5s);
  graph.finish(kA);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  EXPECT_EQ(graph.held_back(kB)->arm, ArmId{1});
}

// B should pass after kC has left its start. But Next is abandoned before it reaches that place, so
// kC never starts.
TEST_F(Graph, UnreachedStartOfAnAbandonedMotionBlocksNothing) {
  admit({motion(kA, 0, 5s)}, {});
  admit({motion(kB, 1, 5s), motion(kNext, 0, 5s), motion(kC, 0, 5s)},
        {{kB, kNext, {region({{2s, 3s, 4s, 5s}})}}, {kB, kC, {region({{2s, 3s, 0s, 1s}})}}});
  graph.progress(kB, 1s);
  graph.granted(kNext, 0s);
  graph.abandon(kC, 0s);
  graph.abandon(kNext, 0s);
  EXPECT_EQ(graph.limit(kB), 5s);
}

TEST_F(Graph, UnreachedGoalDoesNotBlockTheFirstMotion) {
  admit({motion(kA, 0, 20s)}, {});
  admit({motion(kB, 1, 5s), motion(kNext, 0, 5s)}, {{kB, kA, {region({{2s, 3s, 18s, 20s}})}}});
  ASSERT_EQ(graph.limit(kA), 18s - kShortOf);
  graph.abandon(kNext, 0s);
  EXPECT_EQ(graph.limit(kB), 5s);
  EXPECT_EQ(graph.limit(kA), 18s - kShortOf);
}

TEST_F(Graph, GoalStaysBlockedUntilItsMotionIsFinished) {
  let_b_wait_until_next_has_left();
  graph.abandon(kNext, 0s);
  graph.progress(kA, 5s);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf) << "at its goal, but not finished";
  admit({motion(kC, 2, 5s)}, {});
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  graph.finish(kA);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
}

// A is at its goal, in B's way, although its end is not reported yet.
TEST_F(Graph, ReachedGoalIsNotPassedBeforeTheNextMotionHasLeftIt) {
  admit({motion(kA, 0, 5s)}, {});
  graph.granted(kA, 5s);
  admit({motion(kB, 1, 5s), motion(kNext, 0, 20s)},
        {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}, {kB, kNext, {region({{2s, 3s, 0s, 15s}})}}});
  graph.progress(kA, 5s);
  admit({}, {});
  graph.set_outlook(kNext, {.stands_for = 60s});
  admit({}, {});
  EXPECT_LT(graph.limit(kB), 2s);
}

// A stalls, so B is to pass first, before A rests at its goal.
TEST_F(Graph, ReversedOrderReleasesTheMotionThatWaitedForAnAbandonedMotion) {
  admit({motion(kA, 0, 5s)}, {});
  graph.granted(kA, 3s);
  graph.set_outlook(kA, {.keeps_its_place = true});
  admit({motion(kB, 1, 5s), motion(kNext, 0, 4s)},
        {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}, {kB, kNext, {region({{2s, 3s, 0s, 1s}})}}});
  graph.abandon(kNext, 0s);
  ASSERT_EQ(graph.limit(kB), 2s - kShortOf);
  EXPECT_EQ(graph.held_back(kB)->arm, ArmId{0}) << "it will rest there";
  graph.set_outlook(kA, {.stands_for = 60s});
  admit({}, {});
  EXPECT_EQ(graph.limit(kA), 4s - kShortOf);
  EXPECT_EQ(graph.limit(kB), 5s);
}

// ---- Motions of several arms ----

CoordinatedMotion of_both(StepId step, Duration duration) {
  return {.step = step, .arms = {ArmId{0}, ArmId{1}}, .duration = duration};
}

// One arm of the team rests before the region. The arm that is ahead rests inside the region.
TEST_F(Graph, ArmAheadOfItsTeamBlocksToo) {
  admit({of_both(kA, 5s)}, {});
  graph.granted(kA, 5s);
  admit({motion(kB, 2, 5s)}, {{kB, kA, {region({{2s, 3s, 2s, 3s}})}}});
  graph.progress(kA, 1980ms);
  graph.abandon(kA, 1980ms, 2040ms);
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
}

// The team moves the arm that rests in B's way, but only after B. So does the motion behind it.
TEST_F(Graph, ArmLeavesARestOnlyWithItsNextMotion) {
  let_b_wait_until_next_has_left();
  graph.abandon(kNext, 0s);
  graph.progress(kA, 5s);
  graph.finish(kA);
  admit({of_both(kC, 5s)}, {});
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  admit({motion(kNext, 0, 4s)}, {});
  EXPECT_EQ(graph.limit(kB), 2s - kShortOf);
  EXPECT_EQ(graph.held_back(kB)->arm, ArmId{0});
}

// The team follows B. It would have brought its other arm to the start of Next, in B's way.
TEST_F(Graph, ArmThatALaterMotionBringsBlocksNothing) {
  admit({motion(kB, 0, 5s), of_both(kA, 5s), motion(kNext, 1, 5s)},
        {{kNext, kB, {region({{0s, 1s, 2s, 3s}})}}});
  ASSERT_EQ(graph.limit(kB), 5s);
  graph.abandon(kNext, 0s);
  EXPECT_EQ(graph.limit(kB), 5s);
}

// The motion that moves A's arm away also moves B's arm, so it comes after B.
TEST(PassingOrders, MotionDoesNotWaitForADepartureThatFollowsIt) {
  PrecedenceGraph graph(2);
  graph.admit({motion(kA, 0, 5s)}, {});
  graph.granted(kA, 5s);
  const std::vector<CoordinatedMotion> candidates = {motion(kB, 1, 5s), of_both(kNext, 2s)};
  const std::vector<PairRegions> regions = {{kB, kA, {region({{2s, 3s, 4s, 5s}})}}};
  const auto orders = cheapest_orders(graph.question(candidates, regions));
  ASSERT_EQ(orders.blockers.size(), 1u);
  EXPECT_EQ(orders.blockers[0].blocked, kB);
  EXPECT_EQ(orders.blockers[0].other, kA);
}

// A brings both arms to B's start, in C's way.
TEST(PassingOrders, StartThatIsAlreadyOccupiedIsNotPassedFirst) {
  PrecedenceGraph graph(2);
  graph.admit({of_both(kA, 5s)}, {});
  const std::vector<CoordinatedMotion> candidates = {motion(kB, 0, 50s), motion(kC, 1, 5s)};
  const std::vector<PairRegions> regions = {{kB, kC, {region({{0s, 40s, 2s, 3s}})}}};
  const auto orders = cheapest_orders(graph.question(candidates, regions));
  EXPECT_TRUE(orders.blockers.empty());
  ASSERT_EQ(orders.precedences.size(), 1u);
  EXPECT_EQ(orders.precedences[0].first(), kB);
}

}  // namespace
}  // namespace armloom

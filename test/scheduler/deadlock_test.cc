#include <gmock/gmock.h>

#include <random>
#include <set>

#include "core/deadlock/waits_for.h"
#include "core/scheduler/waiting/turns.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

JobId job(std::uint64_t id) { return JobId{id}; }
ArmId arm(std::uint32_t id) { return ArmId{id}; }

// Adds: job `waits` waits for arm `by`, whose next job is `first`.
void add_blocked(std::vector<WaitsForEdge>& edges, std::uint64_t waits, std::uint32_t by,
                 std::uint64_t first) {
  edges.push_back({job(waits), arm(by)});
  edges.push_back({arm(by), job(first)});
}

TEST(Deadlock, IsNotFoundWithoutWaits) { EXPECT_THAT(find_wait_cycles(WaitsFor({})), IsEmpty()); }

TEST(Deadlock, DoesNotIncludeAChainThatEndsAtAnIdleArm) {
  std::vector<WaitsForEdge> edges{{job(3), job(1)}, {job(2), arm(9)}};
  add_blocked(edges, 1, 4, 2);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), IsEmpty());
}

TEST(Deadlock, CycleOfTwoStartsWithTheSmallerId) {
  std::vector<WaitsForEdge> edges;
  add_blocked(edges, 7, 0, 5);
  add_blocked(edges, 5, 1, 7);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), ElementsAre(ElementsAre(job(5), job(7))));
}

TEST(Deadlock, CycleOfThreeIsInOrderOfWaiting) {
  std::vector<WaitsForEdge> edges;
  add_blocked(edges, 1, 2, 3);
  add_blocked(edges, 3, 1, 2);
  add_blocked(edges, 2, 0, 1);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), ElementsAre(ElementsAre(job(1), job(3), job(2))));
}

TEST(Deadlock, CycleMayIncludePassingOrdersAndPredecessors) {
  std::vector<WaitsForEdge> edges{{job(8), job(2)}, {job(4), job(3)}};
  add_blocked(edges, 2, 0, 4);
  add_blocked(edges, 3, 1, 8);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)),
              ElementsAre(ElementsAre(job(2), job(4), job(3), job(8))));
}

TEST(Deadlock, CycleExcludesJobsThatOnlyLeadInOrOut) {
  std::vector<WaitsForEdge> edges{{job(1), job(3)}, {job(9), job(1)}, {job(3), arm(7)}};
  add_blocked(edges, 3, 0, 4);
  add_blocked(edges, 4, 1, 3);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), ElementsAre(ElementsAre(job(3), job(4))));
}

TEST(Deadlock, ArmDoesNotBlockItsOwnJob) {
  std::vector<WaitsForEdge> edges{{job(2), job(2)}};
  add_blocked(edges, 1, 0, 1);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), IsEmpty());
}

TEST(Deadlock, DisjointCyclesAreReportedSeparately) {
  std::vector<WaitsForEdge> edges;
  add_blocked(edges, 3, 0, 6);
  add_blocked(edges, 6, 1, 3);
  add_blocked(edges, 2, 2, 9);
  add_blocked(edges, 9, 3, 2);
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)),
              ElementsAre(ElementsAre(job(2), job(9)), ElementsAre(job(3), job(6))));
}

TEST(Deadlock, ReportsTheShortestCycleOfAComponent) {
  std::vector<WaitsForEdge> edges{{job(1), job(2)}, {job(2), job(3)}, {job(3), job(1)},
                                  {job(3), job(2)}, {job(1), job(4)}, {job(4), job(5)},
                                  {job(5), job(6)}, {job(6), job(1)}};
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), ElementsAre(ElementsAre(job(1), job(2), job(3))));
}

TEST(Deadlock, IsIndependentOfEdgeOrder) {
  std::mt19937_64 random(3);
  std::vector<WaitsForEdge> edges;
  for (int i = 0; i < 60; ++i) edges.push_back({job(random() % 40), job(random() % 40)});
  const std::vector<WaitCycle> rings = find_wait_cycles(WaitsFor(edges));
  ASSERT_FALSE(rings.empty());
  for (int i = 0; i < 20; ++i) {
    std::ranges::shuffle(edges, random);
    EXPECT_EQ(find_wait_cycles(WaitsFor(edges)), rings);
  }
}

TEST(Deadlock, MatchesTheDefinitionOnRandomGraphs) {
  std::mt19937_64 random(4);
  int with = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    std::set<WaitsForEdge> edges;
    const std::uint64_t size = 2 + random() % 12;
    for (std::uint64_t e = 0; e < size; ++e) {
      const JobId a = job(random() % size), b = job(random() % size);
      if (a != b) edges.insert({a, b});
    }
    const WaitsFor graph({edges.begin(), edges.end()});
    bool cyclic = false;
    for (const WaitsForEdge& e : edges) {
      const auto before = graph.all_before(e.first);
      cyclic |= std::ranges::binary_search(before, e.waits);
    }
    const std::vector<WaitCycle> rings = find_wait_cycles(graph);
    EXPECT_EQ(!rings.empty(), cyclic);
    with += cyclic ? 1 : 0;
    for (const WaitCycle& ring : rings) {
      EXPECT_EQ(std::set(ring.begin(), ring.end()).size(), ring.size()) << "elementary";
      for (std::size_t k = 0; k < ring.size(); ++k) {
        EXPECT_TRUE(edges.contains({ring[k], ring[(k + 1) % ring.size()]}));
      }
    }
  }
  EXPECT_GT(with, 100);
  EXPECT_LT(with, 900);
}

TEST(Deadlock, IsFoundInACycleOfAHundredThousandJobs) {
  std::vector<WaitsForEdge> edges;
  for (std::uint64_t i = 1; i < 100'000; ++i) edges.push_back({job(i + 1), job(i)});
  EXPECT_THAT(find_wait_cycles(WaitsFor(edges)), IsEmpty());
  edges.push_back({job(1), job(100'000)});
  ASSERT_EQ(find_wait_cycles(WaitsFor(edges)).size(), 1u);
  EXPECT_EQ(find_wait_cycles(WaitsFor(edges)).front().size(), 100'000u);
}

TEST(Deadlock, CycleCanStartWithAnyOfItsJobs) {
  EXPECT_THAT(beginning_with(job(2), {job(1), job(2), job(3)}),
              ElementsAre(job(2), job(3), job(1)));
  EXPECT_THROW((void)beginning_with(job(9), {job(1), job(2)}), std::invalid_argument);
}

TEST(WaitsFor, AllBeforeListsEveryJobAndArmBeforeAJob) {
  std::vector<WaitsForEdge> edges{{job(3), job(2)}, {job(9), job(3)}};
  add_blocked(edges, 2, 0, 1);
  const WaitsFor graph(edges);
  EXPECT_THAT(graph.all_before(job(3)),
              ElementsAre(Waiter(job(1)), Waiter(job(2)), Waiter(arm(0))));
  EXPECT_THAT(graph.all_before(job(1)), IsEmpty());
  EXPECT_THAT(graph.all_before(job(77)), IsEmpty());
}

TEST(Priorities, AreInheritedByAllThatAnUrgentJobWaitsFor) {
  std::vector<WaitsForEdge> edges{{job(5), job(4)}};
  add_blocked(edges, 4, 0, 3);
  add_blocked(edges, 2, 1, 3);
  EXPECT_THAT(
      effective_priorities(WaitsFor(edges),
                           {{job(1), 1}, {job(2), 2}, {job(3), 0}, {job(4), -1}, {job(5), 7}}),
      ElementsAre(Pair(job(1), 1), Pair(job(2), 2), Pair(job(3), 7), Pair(job(4), 7),
                  Pair(job(5), 7)));
}

TEST(Priorities, NeverDecreaseAndTerminateInACycle) {
  const WaitsFor graph({{job(1), job(2)}, {job(2), job(1)}});
  EXPECT_THAT(effective_priorities(graph, {{job(1), 3}, {job(2), 5}}),
              ElementsAre(Pair(job(1), 5), Pair(job(2), 5)));
}

}  // namespace
}  // namespace armloom

// Random changes of a PrecedenceGraph, without a scheduler. RandomGraph checks the invariants.
#include "test/scheduler/random_graphs.h"

#include <gtest/gtest.h>

#include <string>

#include "test/scenarios/seeds.h"

namespace armloom {
namespace {

TEST(RandomGraphs, ArmsNeverMeet) {
  const std::uint64_t seeds = seed_count(3000);
  RandomGraph::Count all;
  for (std::uint64_t seed = 1; seed <= seeds && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomGraph graph(seed);
    for (int i = 0; i < 60 && !HasFailure(); ++i) EXPECT_NO_THROW(graph.change());
    all.finished += graph.count().finished;
    all.abandoned += graph.count().abandoned;
    all.held += graph.count().held;
    all.reversed += graph.count().reversed;
  }
  if (HasFailure()) return;
  EXPECT_GT(all.finished, seeds);
  EXPECT_GT(all.abandoned, seeds / 2);
  EXPECT_GT(all.held, seeds);
  EXPECT_GT(all.reversed, seeds / 4);
}

}  // namespace
}  // namespace armloom

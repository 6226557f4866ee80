// 3,000 random command sequences through the whole executive: whatever is asked in whatever order,
// every job, the server's own included, reaches exactly one terminal state, events, jobs and queue
// tell the same story, no reservation outlives its job, arms do not go aside for ever, and nothing
// touches but for what a fault or the coarse step lets through (the monitor's business).
#include "test/scenarios/random_commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "test/scenarios/seeds.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace random_commands;

constexpr std::uint64_t kSequences = 2000;  // of each policy its share
constexpr std::uint64_t kParked = 60;       // of each policy, under "park"

World crossing_world() {
  return {{"x", "y"}, crossing_description(), 400, 10, [](const Configuration& q) {
            return q.norm() - 0.2;
          }};
}
World unwatched_crossing_world() {  // for a policy that lets them touch
  World world = crossing_world();
  world.apart_m = nullptr;
  return world;
}

// Both on one line, where they pass each other only if one goes aside: home, or behind their ends.
World line_world() {
  World world{{"a", "b"}, polygon(2), 1500, 4, [](const Configuration& q) {
                return std::abs(q[0] + q[1]) - 0.2;
              }};
  world.description.robots.pop_back();
  world.description.scheduling.on_idle_blocker = OnIdleBlocker::park;
  for (RobotDescription& robot : world.description.robots) {
    robot.srdf = source_dir() + "/test/scenarios/data/slider_with_back.srdf";
  }
  return world;
}

World unwatched_line_world() {
  World world = line_world();
  world.apart_m = nullptr;
  return world;
}

void expect_much_was_done(const Tally& all, std::uint64_t sequences) {
  std::cout << sequences << " sequences: " << all.submitted << " jobs submitted, " << all.accepted
            << " accepted, " << all.succeeded << " succeeded; " << all.cancels << " cancels, "
            << all.faults << " faults, " << all.changes << " changes of the scene\n";
  ASSERT_GE(sequences, 1U);
  EXPECT_GE(2 * all.accepted, all.submitted);
  EXPECT_GE(all.accepted, 4 * sequences);
  if (sequences < 50) return;               // what follows is seldom
  EXPECT_GE(4 * all.succeeded, sequences);  // of a sequence five faults, cancels, stops
  EXPECT_GE(2 * all.cancels, sequences);
  EXPECT_GE(2 * all.faults, sequences);
  EXPECT_GE(2 * all.changes, sequences);
}

void run_sequences(std::uint64_t first, std::uint64_t last, const std::string& policy,
                   World (*world)() = crossing_world) {
  Tally all;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    SCOPED_TRACE(policy + ", seed " + std::to_string(seed));
    const Tally one = RandomCommands(seed, policy, world()).run();
    if (::testing::Test::HasFailure()) return;
    all.submitted += one.submitted;
    all.accepted += one.accepted;
    all.succeeded += one.succeeded;
    all.cancels += one.cancels;
    all.faults += one.faults;
    all.changes += one.changes;
  }
  expect_much_was_done(all, last + 1 - first);
}

// At least one of each policy, however few are asked for.
std::uint64_t sequences() { return std::max<std::uint64_t>(4, seed_count(kSequences)); }

TEST(RandomCommands, EveryJobReachesExactlyOneEnd) {
  run_sequences(1, sequences() * 3 / 10, "timed_discrete", unwatched_crossing_world);
}
TEST(RandomCommands, EveryJobReachesExactlyOneEndUnderCertified) {
  run_sequences(sequences() * 3 / 10 + 1, sequences() * 13 / 20, "certified");
}
TEST(RandomCommands, EveryJobReachesExactlyOneEndUnderEarliestStart) {
  run_sequences(sequences() * 13 / 20 + 1, sequences(), "earliest_start");
}
TEST(RandomCommands, EveryJobReachesExactlyOneEndUnderCoordinated) {
  run_sequences(sequences() + 1, sequences() * 27 / 20, "coordinated");
}

class RandomCommandsUnderPark : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, RandomCommandsUnderPark, ::testing::ValuesIn(known_policies()));

TEST_P(RandomCommandsUnderPark, EveryJobReachesExactlyOneEndAndArmsDoNotGoAsideForEver) {
  const bool promises = GetParam() != "timed_discrete";
  run_sequences(1, seed_count(kParked), GetParam(), promises ? line_world : unwatched_line_world);
}

// A move of the server's own pauses before an arm in a fault, and closes a ring when that has a job
// again: it ends for the ring when it has come to rest, and still says which.
TEST(RandomCommandsUnderParkOnce, AJobThatBrakesForItsRingKeepsItAsTheReason) {
  run_sequences(230, 230, "coordinated", line_world);
}

}  // namespace
}  // namespace armloom

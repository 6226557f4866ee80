// An arm without a job that rests in the way: told, or sent aside and back (on_idle_blocker).
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

CellDescription parking(const std::string& on_idle_blocker) {
  CellDescription cell = crossing_description();
  cell.scheduling.on_idle_blocker = on_idle_blocker;
  return cell;
}

class Aside : public ::testing::TestWithParam<const char*> {
 protected:
  // x has come to rest in the crossing, and y wants to pass.
  void start(const std::string& on_idle_blocker) {
    cell.emplace(parking(on_idle_blocker), GetParam());
    cell->submit(slide("x", -1, 0, 2, "in the middle"));
    cell->run_until(at(3s));
    ASSERT_EQ(cell->job("in the middle").state, JobState::succeeded);
    cell->submit(slide("y", -1, 1, 3, "passes"));
  }
  std::optional<Crossing> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, Aside,
                         ::testing::Values("coordinated", "earliest_start", "certified",
                                           "reservation", "timed_discrete", "lockstep",
                                           "sequential"));

TEST_P(Aside, AnIdleArmInTheWayIsTold) {
  start("report");
  cell->run_until(at(10s));
  const JobView waits = cell->job("passes");
  EXPECT_EQ(waits.state, JobState::backlogged);
  ASSERT_FALSE(waits.waits_on.empty());
  EXPECT_EQ(waits.waits_on[0].kind, Wait::Kind::arm);
  EXPECT_EQ(waits.waits_on[0].arm, "x");
}

TEST_P(Aside, AnIdleArmInTheWayGoesBackWhereItCameFrom) {
  start("park");
  cell->run_to_the_end(at(20s));
  EXPECT_EQ(cell->job("passes").state, JobState::succeeded);
  const JobView aside = cell->job("aside-1");
  EXPECT_EQ(aside.state, JobState::succeeded);
  EXPECT_EQ(aside.name, "x moves aside for passes");
  EXPECT_NEAR(cell->log.last[0], -1.0, 1e-3);
  EXPECT_GT(cell->log.closest_m, 0.01);
}

TEST_P(Aside, ItReturnsForAJobThatBeginsWhereItWasLeft) {
  start("park");
  cell->run_to_the_end(at(20s));
  cell->submit(slide("x", 0, 1, 2, "goes on"));
  cell->run_to_the_end(at(40s));
  EXPECT_EQ(cell->job("aside-2").state, JobState::succeeded);
  EXPECT_EQ(cell->job("goes on").state, JobState::succeeded);
  EXPECT_NEAR(cell->log.last[0], 1.0, 1e-3);
}

TEST_P(Aside, AJobThatBeginsWhereItStandsNowNeedsNoReturn) {
  start("park");
  cell->run_to_the_end(at(20s));
  cell->submit(slide("x", -1, 1, 2, "from here"));
  cell->run_to_the_end(at(40s));
  EXPECT_EQ(cell->job("from here").state, JobState::succeeded);
  EXPECT_FALSE(cell->simulation->executive().job("aside-2"));
}

// Nowhere to go: it stays told, and nothing hangs in a circle.
TEST_P(Aside, AnArmThatHasNowhereToGoStaysAndIsTold) {
  CellDescription description = parking("park");
  description.robots[0].arms[0].home = {0.0};
  cell.emplace(description, GetParam());
  cell->submit(slide("y", -1, 1, 3, "passes"));
  cell->run_until(at(10s));
  EXPECT_EQ(cell->job("passes").state, JobState::backlogged);
  EXPECT_FALSE(cell->simulation->executive().job("aside-1"));
}

}  // namespace
}  // namespace armloom

// T10: jobs that block each other's goals in a swap, while an uninvolved arm is present.
#include <gtest/gtest.h>

#include "test/scenarios/polygon.h"

namespace armloom {
namespace {

class GoalSwap : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, GoalSwap, ::testing::ValuesIn(known_policies()));

TEST_P(GoalSwap, ReportsTheCycleAtOnceAndFailsTheLastJob) {
  Crossing cell(polygon(2), GetParam());
  cell.run_until(at(1s));
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.run_until(at(1100ms));
  const auto one = deadlock_of(cell, "one"), two = deadlock_of(cell, "two");
  ASSERT_TRUE(one && two) << "within 0.1 s";
  EXPECT_EQ(one->ring, (Keys{"one", "two"}));
  EXPECT_EQ(two->ring, (Keys{"two", "one"}));

  const JobView failed = cell.job("two");
  EXPECT_EQ(failed.state, JobState::failed);
  EXPECT_EQ(failed.reason(), Reason::deadlock);
  EXPECT_EQ(
      failed.detail(),
      "two -> one -> two: each waits for the next one, so none can move; submit a job before them "
      "that moves an arm out of the others' paths, or set \"on_idle_blocker\": \"park\" or "
      "\"replan\" in the cell's scheduling, so that an arm retreats if a path is free");
  const JobView stays = cell.job("one");
  EXPECT_EQ(stays.state, JobState::backlogged);
  EXPECT_TRUE(stays.cycle.empty());
  ASSERT_EQ(stays.waits_on.size(), 1u);
  EXPECT_EQ(stays.waits_on.front().kind, Wait::Kind::arm);
  EXPECT_EQ(stays.waits_on.front().arm, "b");

  cell.run_to_the_end(at(100s));
  EXPECT_EQ(cell.job("one").state, JobState::expired) << "nothing ever moved arm b away";
}

TEST_P(GoalSwap, CheckReportsTheCycleThatTheJobWouldClose) {
  Crossing cell(polygon(2), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.run_until(at(100ms));
  std::optional<CheckView> said;
  cell.simulation->executive().inquiries().check(
      slide("b", -1, 1, 4, "two"), [&](Result<CheckView> answer) { said = answer.value(); });
  while (!said && cell.simulation->now() < at(5s)) cell.simulation->tick();
  ASSERT_TRUE(said && said->result);
  EXPECT_EQ(said->result->reason, Reason::deadlock);
  EXPECT_EQ(
      said->result->detail.rfind("this job -> one -> this job: each waits for the next one", 0), 0U)
      << said->result->detail;
}

}  // namespace
}  // namespace armloom

// T10: jobs that block each other's goals, two in a swap and three in a ring, beside an arm that
// has nothing to do with it.
#include <gtest/gtest.h>

#include "test/scenarios/polygon.h"

namespace armloom {
namespace {

class T10 : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, T10, ::testing::ValuesIn(known_policies()));

TEST_P(T10, ASwapOfTwoGoalsIsNamedAtOnceAndTheLastJobGivesWay) {
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
      "two -> one -> two: none of them can move before the next one does; a job before them that "
      "moves an arm out of the others' way would open the ring, or \"on_idle_blocker\": "
      "\"park\" or \"replan\" in the cell's scheduling, which send one aside where there is a free "
      "way");
  const JobView stays = cell.job("one");
  EXPECT_EQ(stays.state, JobState::backlogged);
  EXPECT_TRUE(stays.ring.empty());
  ASSERT_EQ(stays.waits_on.size(), 1u);
  EXPECT_EQ(stays.waits_on.front().kind, Wait::Kind::arm);
  EXPECT_EQ(stays.waits_on.front().arm, "b");

  cell.run_to_the_end(at(100s));
  EXPECT_EQ(cell.job("one").state, JobState::expired) << "nothing ever moved arm b away";
}

TEST_P(T10, ACheckSaysWhichRingTheJobWouldCloseAndHowItWouldEnd) {
  Crossing cell(polygon(2), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.run_until(at(100ms));
  std::optional<CheckView> said;
  cell.simulation->executive().check(slide("b", -1, 1, 4, "two"),
                                     [&](Result<CheckView> answer) { said = answer.value(); });
  while (!said && cell.simulation->now() < at(5s)) cell.simulation->tick();
  ASSERT_TRUE(said && said->result);
  EXPECT_EQ(said->result->reason, Reason::deadlock);
  EXPECT_EQ(said->result->detail.rfind("this job -> one -> this job: none of them can move", 0), 0U)
      << said->result->detail;
}

TEST_P(T10, ARingOfThreeIsNamedAtOnceAndOpensWhenOneArmMovesAway) {
  Crossing cell(polygon(3), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.submit(slide("c", -1, 1, 4, "three"));
  cell.submit(slide("free", -1, 1, 4, "far"));
  if (GetParam() == "coordinated") {  // all three can go at once: it is none
    cell.run_to_the_end();
    for (const char* key : {"one", "two", "three", "far"}) {
      EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
    }
    return;
  }
  cell.run_until(at(100ms));
  const auto one = deadlock_of(cell, "one"), three = deadlock_of(cell, "three");
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->ring, (Keys{"one", "two", "three"}));
  EXPECT_EQ(three->ring, (Keys{"three", "one", "two"}));
  EXPECT_EQ(cell.job("three").reason(), Reason::deadlock);
  EXPECT_EQ(cell.job("one").state, JobState::backlogged);
  EXPECT_EQ(cell.job("two").state, JobState::backlogged);

  cell.run_until(at(10s));
  EXPECT_EQ(cell.job("far").state, JobState::succeeded) << "others go on";
  cell.submit(slide("c", -1, -2, 3, "away"));
  cell.run_to_the_end();
  for (const char* key : {"one", "two", "away"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
  }
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0u);
}

TEST_P(T10, ARingThatArisesWhileArmsMoveIsNamedWhenTheLastOfThemStands) {
  Crossing cell(polygon(2), GetParam());
  cell.submit(slide("a", -1, -0.5, 2, "a1"));
  cell.submit(slide("a", -0.5, 1, 4, "a2"));
  cell.submit(slide("b", -1, -0.5, 3, "b1"));
  cell.submit(slide("b", -0.5, 1, 4, "b2"));
  cell.run_until(at(1s));
  EXPECT_FALSE(deadlock_of(cell, "a2"));
  cell.run_until(at(8s));
  const auto told = deadlock_of(cell, "b2");
  ASSERT_TRUE(told);
  EXPECT_EQ(told->ring, (Keys{"b2", "a2"}));
  const TimePoint stood = std::max(*cell.job("a1").times.ended_at, *cell.job("b1").times.ended_at);
  EXPECT_GE(told->when, stood);
  EXPECT_LE(told->when, stood + 100ms);
  EXPECT_EQ(cell.job("b2").reason(), Reason::deadlock);
}

TEST(T10, AnIdleArmInTheWayIsNoDeadlock) {
  Crossing cell(polygon(2), "certified");
  cell.submit(slide("a", -1, 1, 4, "waits"));
  cell.run_until(at(5s));
  EXPECT_EQ(cell.job("waits").state, JobState::backlogged);
  EXPECT_EQ(cell.job("waits").waits_on.front().arm, "b");
  EXPECT_FALSE(deadlock_of(cell, "waits"));
}

}  // namespace
}  // namespace armloom

#include <set>

#include "test/scenarios/polygon.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

// Gives every arm a pose "back", 1 m behind its corner.
CellDescription parking_polygon(int corners) {
  CellDescription cell = polygon(corners);
  cell.scheduling.on_idle_blocker = OnIdleBlocker::park;
  for (RobotDescription& robot : cell.robots) {
    robot.srdf = source_dir() + "/test/scenarios/data/slider_with_back.srdf";
  }
  return cell;
}

class InADeadlock : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, InADeadlock, ::testing::ValuesIn(known_policies()));

// Both arms share one line, and each has its goal where the other arm is. b retreats behind its
// corner, and a passes to b's place. Then a retreats, so that b can return and move.
TEST_P(InADeadlock, OneOfTwoArmsRetreatsAndReturns) {
  Crossing cell(parking_polygon(2), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.run_until(at(100ms));
  EXPECT_TRUE(deadlock_of(cell, "one")) << "it is told all the same";
  cell.run_to_the_end(at(60s));
  EXPECT_EQ(cell.job("one").state, JobState::succeeded);
  EXPECT_EQ(cell.job("two").state, JobState::succeeded);
  EXPECT_EQ(cell.job("retreat-1").name, "b retreats for one");
  EXPECT_EQ(cell.job("retreat-2").name, "b returns to where it rested");
  EXPECT_EQ(cell.job("retreat-1").state, JobState::succeeded);
  EXPECT_EQ(cell.job("retreat-2").state, JobState::succeeded);
  EXPECT_LT(*cell.job("one").times.started_at, *cell.job("retreat-2").times.started_at)
      << "b lets it pass";
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0u);
}

TEST_P(InADeadlock, OneOfThreeArmsRetreatsAndReturns) {
  Crossing cell(parking_polygon(3), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.submit(slide("c", -1, 1, 4, "three"));
  cell.run_to_the_end(at(100s));
  for (const char* key : {"one", "two", "three"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
  }
  EXPECT_EQ(cell.simulation->executive().figures().monitor_stops, 0u);
}

TEST_P(InADeadlock, EveryJobIsPublishedBeforeOthersWaitForIt) {
  Crossing cell(parking_polygon(2), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.run_to_the_end(at(60s));
  std::set<std::string> told;
  for (const Event& event : cell.log.events) {
    const auto* job = std::get_if<JobView>(&event.body);
    if (job == nullptr) continue;
    for (const WaitView& wait : job->waits_on) {
      EXPECT_TRUE(wait.job.empty() || told.contains(wait.job)) << job->key << ": " << wait.job;
    }
    told.insert(job->key);
  }
  EXPECT_TRUE(told.contains("retreat-2"));
}

TEST_P(InADeadlock, RetreatIsCanceledWithTheJobThatItHelps) {
  Crossing cell(parking_polygon(2), GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  while (!cell.simulation->executive().job("retreat-1")) cell.simulation->tick();
  ASSERT_TRUE(cell.simulation->executive().cancel("one"));
  cell.submit(slide("a", -1, -2, 3, "leaves"));
  cell.run_to_the_end(at(60s));
  EXPECT_EQ(cell.job("retreat-1").state, JobState::canceled);
  EXPECT_EQ(cell.job("retreat-2").state, JobState::canceled);
  EXPECT_EQ(cell.job("two").state, JobState::succeeded);
}

TEST_P(InADeadlock, LastJobFailsAtOnceWithoutARetreat) {
  CellDescription description = polygon(2);
  description.scheduling.on_idle_blocker = OnIdleBlocker::park;  // the arms are at home
  Crossing cell(description, GetParam());
  cell.submit(slide("a", -1, 1, 4, "one"));
  cell.submit(slide("b", -1, 1, 4, "two"));
  cell.run_until(at(100ms));
  EXPECT_EQ(cell.job("two").reason(), Reason::deadlock);
  EXPECT_NE(cell.job("two").detail().find("or clear a retreat for one of the arms: none was free"),
            std::string::npos);
  EXPECT_FALSE(cell.simulation->executive().job("retreat-1"));
}

}  // namespace
}  // namespace armloom

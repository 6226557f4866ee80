// Jobs with steps at an object: what may touch it, and which job has its arm.
#include <gmock/gmock.h>

#include "test/scenarios/tasks.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

// The hand is still at the part when its job ends: a later job must be able to move away.
TEST(Task, LeavesThePartInALaterJob) {
  Tasks cell;
  cell.submit(task("place", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", 0.5), detach(),
                             slide_to("x", 0.495)}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("place").state, JobState::succeeded) << cell.job("place").detail();
  EXPECT_EQ(cell.scene().scene()->touch().size(), 1U) << "the hand is still at the part";
  cell.submit(move_to("x", -1.0, "away"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("away").state, JobState::succeeded) << cell.job("away").detail();
  EXPECT_TRUE(cell.scene().scene()->touch().empty());
}

TEST(Task, MayNotTouchAPartThatAClientHasMovedMeanwhile) {
  Tasks cell;
  cell.submit(task("place", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", 0.5), detach(),
                             slide_to("x", 0.495)}));
  cell.run_to_the_end();
  ASSERT_EQ(cell.scene().scene()->touch().size(), 1U) << "the hand is still at the part";
  ASSERT_TRUE(cell.scene().replace(part_at(-0.3)));
  EXPECT_TRUE(cell.scene().scene()->touch().empty());
  cell.submit(move_to("x", -1.0, "through"));
  cell.run_to_the_end();
  EXPECT_NE(cell.job("through").state, JobState::succeeded) << "the part is in its way";
}

TEST(Task, PutsDownWhatAnotherHandIsStillAt) {
  Tasks cell;
  cell.submit(task("hand over", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", -0.26),
                                 slide_to("y", 0.0), attach("y_ball"), slide_to("y", 0.005),
                                 detach(), slide_to("y", -1.0), slide_to("x", -1.0)}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("hand over").state, JobState::succeeded) << cell.job("hand over").detail();
  EXPECT_TRUE(cell.scene().scene()->touch().empty());
}

// y's earlier job must pass where x offers the part. x makes way, and comes back for y's hand.
TEST(Task, ComesBackToWhereItGivesAnObject) {
  CellDescription description = with_io();
  description.scheduling.on_idle_blocker = OnIdleBlocker::park;
  Tasks cell(description);
  JobRequest through = slide("y", -1, 1, 4, "through");
  through.terms.start_when = SignalCondition{"ready", true};
  cell.submit(std::move(through));
  cell.submit(task("hand over",
                   {slide_to("x", 0.0), attach("x_ball"), slide_to("x", -0.26), slide_to("y", 0.0),
                    attach("y_ball"), slide_to("x", -1.0), slide_to("y", -1.0)}));
  while (cell.simulation->now() < at(6s)) cell.simulation->tick();
  ASSERT_TRUE(cell.executive().signals().set("ready", true));
  while (!cell.executive().all_ended() && cell.simulation->now() < at(60s)) cell.simulation->tick();
  EXPECT_EQ(cell.job("through").state, JobState::succeeded) << cell.job("through").detail();
  EXPECT_EQ(cell.job("hand over").state, JobState::succeeded) << cell.job("hand over").detail();
}

TEST(Task, KeepsTheArmThatGivesAnObject) {
  Tasks cell;
  JobRequest request =
      task("hand over", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", -0.26),
                         slide_to("y", 0.0), attach("y_ball"), slide_to("y", -1.0)});
  const auto refused = cell.executive().submit(std::move(request));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, "/steps/4/attach/object");
  EXPECT_THAT(refused.error().front().detail, HasSubstr("moves x"));
}

// y's motion waits for x, which the job itself moves only afterwards.
TEST(Task, EndsIfItsMotionsWaitForEachOther) {
  Tasks cell;
  ASSERT_TRUE(cell.scene().remove("part"));
  JobRequest request = task("crossed", {slide_to("x", 0.0), set("valve", true), slide_to("y", 1.0),
                                        set("valve", false), slide_to("x", 1.0)});
  request.terms.backlog_timeout = 5s;
  cell.submit(request);
  while (!cell.executive().all_ended() && cell.simulation->now() < at(60s)) cell.simulation->tick();
  const JobView job = cell.job("crossed");
  EXPECT_EQ(job.reason(), Reason::deadlock) << job.detail();
  EXPECT_THAT(job.detail(), HasSubstr("motions of crossed wait for each other"));
}

// The first job should have given the part to y, and failed.
TEST(Task, EndsIfAnArmThatItDoesNotMoveHoldsThePart) {
  Tasks cell;
  cell.submit(task("hand over", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", -0.5),
                                 attach("y_ball"), slide_to("x", -1.0), slide_to("y", -1.0)}));
  cell.submit(task("put down", {slide_to("y", -0.9), detach(), slide_to("y", -1.0)}));
  cell.run_to_the_end();
  ASSERT_EQ(cell.job("hand over").state, JobState::failed);
  const JobView job = cell.job("put down");
  EXPECT_EQ(job.reason(), Reason::step_failed);
  EXPECT_THAT(job.detail(), HasSubstr("what the arms hold has changed"));
}

}  // namespace
}  // namespace armloom

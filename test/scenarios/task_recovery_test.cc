// Jobs with steps that fail: steps that are tried again, and what an operator does with what an arm
// still holds.
#include <gmock/gmock.h>

#include "test/scenarios/tasks.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

StepRequest retried(StepRequest step, int retry) {
  step.retry = retry;
  return step;
}

void run_until(Tasks& cell, TimePoint until) {
  while (cell.simulation->now() < until) cell.simulation->tick();
}

void run_to_the_end(Tasks& cell) {
  while (!cell.executive().all_ended() && cell.simulation->now() < at(60s)) cell.simulation->tick();
}

// A camera sees the part later.
TEST(Retry, AttachesThePartOnceItIsThere) {
  Tasks cell;
  ASSERT_TRUE(cell.scene().remove("part"));
  auto steps = pick_and_place();
  steps[1] = retried(steps[1], 5);
  ASSERT_TRUE(cell.scene().add(part_at(0.5)));
  cell.submit(task("pick", std::move(steps)));
  run_until(cell, at(4s));
  const JobView waiting = cell.job("pick");
  EXPECT_EQ(waiting.state, JobState::paused);
  ASSERT_EQ(waiting.waits_on.size(), 1U);
  EXPECT_THAT(waiting.waits_on.front().detail, HasSubstr("of 5 begins in 1 s: part is"));
  ASSERT_TRUE(cell.scene().replace(part_at(0.13)));
  run_to_the_end(cell);
  EXPECT_EQ(cell.job("pick").state, JobState::succeeded) << cell.job("pick").detail();
}

TEST(Retry, EndsWithTheLastTry) {
  Tasks cell;
  cell.submit(task(
      "wait", {slide_to("x", -0.9), retried({"", WaitIoRequest{"ready", true, Duration(500ms)}}, 2),
               slide_to("x", -1.0)}));
  run_to_the_end(cell);
  const JobView job = cell.job("wait");
  EXPECT_EQ(job.reason(), Reason::step_failed);
  // Three tries of 0.5 s, and two pauses of 1 s.
  const double waited_s = to_seconds(*job.times.ended_at - *job.times.started_at);
  EXPECT_GT(waited_s, 3.5);
  EXPECT_LT(waited_s, 4.5);
}

TEST(Retry, PlansAgainOnceTheGoalIsFree) {
  Tasks cell;
  ASSERT_TRUE(cell.scene().replace(part_at(0.5)));
  cell.submit(task("go", {slide_to("x", -0.5), retried(slide_to("x", 0.5), 4)}));
  run_until(cell, at(4s));
  const JobView waiting = cell.job("go");
  EXPECT_EQ(waiting.state, JobState::paused);
  ASSERT_EQ(waiting.waits_on.size(), 1U);
  EXPECT_THAT(waiting.waits_on.front().detail, HasSubstr("of 4 begins in 1 s: "));
  ASSERT_TRUE(cell.scene().remove("part"));
  run_to_the_end(cell);
  EXPECT_EQ(cell.job("go").state, JobState::succeeded) << cell.job("go").detail();
}

TEST(Retry, EndsWithTheLastPlan) {
  Tasks cell;
  ASSERT_TRUE(cell.scene().replace(part_at(0.5)));
  cell.submit(task("go", {slide_to("x", -0.5), retried(slide_to("x", 0.5), 2)}));
  run_to_the_end(cell);
  const JobView job = cell.job("go");
  EXPECT_EQ(job.reason(), Reason::no_plan);
  EXPECT_EQ(job.result->step, 1U);
  EXPECT_GT(to_seconds(*job.times.ended_at - *job.times.started_at), 2.0);
}

// The part is known to be at its place again before the first job has begun.
TEST(Task, PicksWhatAJobBeforeItPlaces) {
  Tasks cell;
  cell.submit(task("there", pick_and_place()));
  cell.submit(task("back", {slide_to("x", 0.5), attach("x_ball"), slide_to("x", 0.0), detach(),
                            slide_to("x", -1.0)}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("back").state, JobState::succeeded) << cell.job("back").detail();
  EXPECT_NEAR(cell.x_of_part(), 0.13, 2e-3);
  const auto refused = cell.executive().submit(task("none", {slide_to("x", 0.0), detach()}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().slug, "not-held");
}

// The part that x holds is at the hand of y, whose job was accepted before.
TEST(Task, LeavesWhatAnotherJobHolds) {
  Tasks cell;
  cell.submit(task("holder", {slide_to("x", 0.0),
                              attach("x_ball"),
                              slide_to("x", -0.26),
                              {"", WaitRequest{5s}},
                              slide_to("x", -1.0),
                              detach(),
                              slide_to("x", -0.9)}));
  cell.submit(task(
      "thief", {{"", WaitRequest{4s}}, slide_to("y", 0.0), attach("y_ball"), slide_to("y", 1.0)}));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("holder").state, JobState::succeeded) << cell.job("holder").detail();
  EXPECT_EQ(cell.job("thief").reason(), Reason::step_failed);
  // It kept its clearance while x held the part, so it came too late.
  EXPECT_THAT(cell.job("thief").detail(), HasSubstr("or more from y_ball"));
}

// It would begin with the part in the hand, which it is to pick.
TEST(Task, FailsBeforeItMovesIfTheHandHoldsSomethingElse) {
  Tasks cell;
  cell.submit(task("there", {slide_to("x", 0.0),
                             attach("x_ball"),
                             slide_to("x", 0.5),
                             {"", WaitIoRequest{"ready", true}},
                             detach(),
                             slide_to("x", -1.0)}));
  cell.submit(task("back", {slide_to("x", 0.5), attach("x_ball"), slide_to("x", 0.0), detach(),
                            slide_to("x", -1.0)}));
  while (cell.job("there").step != 3) cell.simulation->tick();
  ASSERT_TRUE(cell.executive().cancel("there"));
  cell.run_to_the_end();
  const JobView back = cell.job("back");
  EXPECT_EQ(back.reason(), Reason::step_failed);
  EXPECT_THAT(back.detail(), HasSubstr("what the arms hold has changed"));
  EXPECT_FALSE(back.times.started_at);
}

// An object is seen at the goal of the second motion while the first one is under way.
TEST(Task, PlansALaterMotionAgainAtItsTurn) {
  Tasks cell;
  ASSERT_TRUE(cell.scene().remove("part"));
  cell.submit(task("go", {slide_to("x", 0.0), slide_to("x", 1.0)}));
  while (cell.executive().arms().front().state != ArmState::moving) cell.simulation->tick();
  ASSERT_TRUE(cell.scene().add(part_at(1.05)));
  run_until(cell, cell.simulation->now() + 300ms);
  ASSERT_TRUE(cell.scene().remove("part"));
  run_to_the_end(cell);
  EXPECT_EQ(cell.job("go").state, JobState::succeeded) << cell.job("go").detail();
}

TEST(Task, OfABatchHoldsWhatTheOneBeforeHasTaken) {
  Tasks cell;
  std::vector<JobRequest> both;
  both.push_back(task("pick", {slide_to("x", 0.0), attach("x_ball"), slide_to("x", 0.5)}));
  both.push_back(task("place", {slide_to("x", 0.4), detach(), slide_to("x", -1.0)}));
  const auto answers = submit_batch(cell.executive(), std::move(both), true);
  ASSERT_TRUE(answers) << answers.error().front().detail;
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("place").state, JobState::succeeded) << cell.job("place").detail();
}

// At speed override 0, actions wait like motions, and the job says so. Meanwhile, its arm is not
// idle.
TEST(Task, WaitsBetweenMotionsWhileTheSpeedOverrideIsZero) {
  Tasks cell;
  cell.submit(
      task("io", {slide_to("x", -0.5), {"", WaitIoRequest{"ready", true}}, slide_to("x", -1.0)}));
  while (cell.job("io").step != 1) cell.simulation->tick();
  cell.simulation->tick();
  EXPECT_EQ(cell.executive().arms().front().state, ArmState::paused);
  EXPECT_EQ(cell.executive().arms().front().job, "io");
  ASSERT_EQ(cell.job("io").waits_on.front().kind, Wait::Kind::io);
  cell.executive().set_speed(std::nullopt, 0.0);
  ASSERT_TRUE(cell.executive().signals().set("ready", true));
  run_until(cell, cell.simulation->now() + 1s);
  EXPECT_EQ(cell.job("io").step, 1U);
  ASSERT_EQ(cell.job("io").waits_on.front().kind, Wait::Kind::speed);
  cell.executive().set_speed(std::nullopt, 1.0);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("io").state, JobState::succeeded) << cell.job("io").detail();
  EXPECT_EQ(cell.executive().arms().front().state, ArmState::idle);
}

// y waits for the part, which stays in the hand of x.
TEST(Task, GoesOnWithRetriesIfAnotherJobEndsWithTheObjectInItsHand) {
  Tasks cell;
  cell.submit(task("holder", {slide_to("x", 0.0),
                              attach("x_ball"),
                              slide_to("x", 0.5),
                              {"", WaitIoRequest{"ready", true, Duration(2s)}},
                              detach(),
                              slide_to("x", -1.0)}));
  cell.submit(
      task("late", {slide_to("y", -0.9), retried(attach("y_ball"), 4), slide_to("y", -1.0)}));
  while (!is_terminal(cell.job("holder").state)) cell.simulation->tick();
  ASSERT_EQ(cell.job("holder").reason(), Reason::step_failed);
  EXPECT_FALSE(is_terminal(cell.job("late").state)) << cell.job("late").detail();
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("late").step, 1U);
  EXPECT_EQ(cell.job("late").detail().find("what the arms hold has changed"), std::string::npos);
}

std::string slug_of(const Result<CollisionObject>& answer) {
  return answer ? "" : answer.error().front().slug;
}

// The job ends while the arm holds the part, and no job would detach it.
TEST(Detach, LetsGoOfWhatAFailedJobHolds) {
  Tasks cell;
  EXPECT_EQ(slug_of(cell.executive().detach("part")), "not-held");
  EXPECT_EQ(slug_of(cell.executive().detach("trap")), "unknown-object");
  cell.submit(task("pick", {slide_to("x", 0.0),
                            attach("x_ball"),
                            slide_to("x", 0.5),
                            {"", WaitIoRequest{"ready", true, Duration(2s)}},
                            detach(),
                            slide_to("x", -1.0)}));
  const auto is_at = [&](std::size_t step) { return cell.job("pick").step == step; };
  while (!is_at(2) || cell.executive().arms().front().state != ArmState::moving)
    cell.simulation->tick();
  EXPECT_EQ(slug_of(cell.executive().detach("part")), "arm-moves");
  while (!is_at(3)) cell.simulation->tick();
  cell.simulation->tick();
  EXPECT_EQ(slug_of(cell.executive().detach("part")), "job-under-way");
  run_to_the_end(cell);
  ASSERT_EQ(cell.job("pick").reason(), Reason::step_failed);
  const auto placed = cell.executive().detach("part");
  ASSERT_TRUE(placed) << placed.error().front().detail;
  EXPECT_NEAR(placed->X_WO.translation().x(), 0.63, 1e-3);
  EXPECT_NEAR(cell.x_of_part(), 0.63, 1e-3);
  cell.submit(move_to("x", -1.0, "away"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("away").state, JobState::succeeded) << cell.job("away").detail();
  EXPECT_TRUE(cell.scene().scene()->touch().empty());
}

}  // namespace
}  // namespace armloom

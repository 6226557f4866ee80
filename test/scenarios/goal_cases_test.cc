#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

CollisionObject box_at(const std::string& name, double x, double y) {
  CollisionObject object{.name = name, .shape = Box{{0.1, 0.1, 0.1}}};
  object.X_WO.translation() = Eigen::Vector3d(x, y, 0.0);
  return object;
}

class Goals : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { cell.emplace(crossing_description(), GetParam()); }
  void expect_at(double x, double y) const {
    EXPECT_NEAR(cell->log.last[0], x, 1e-3);
    EXPECT_NEAR(cell->log.last[1], y, 1e-3);
  }
  std::optional<Crossing> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, Goals, ::testing::ValuesIn(known_policies()));

TEST_P(Goals, WaitForTheirPlanAndThenRun) {
  const JobView accepted = cell->submit(move_to("x", 0.5, "there"));
  EXPECT_EQ(accepted.motion.planned, false);
  EXPECT_EQ(accepted.arms, std::vector<std::string>{"x"});
  EXPECT_EQ(cell->job("there").waits_on.at(0).kind, Wait::Kind::plan);
  cell->run_to_the_end(at(10s));
  EXPECT_EQ(cell->job("there").state, JobState::succeeded);
  EXPECT_EQ(cell->job("there").motion.planned, true);
  expect_at(0.5, -1.0);
}

TEST_P(Goals, StartWhereThePreviousJobEnds) {
  cell->submit(move_to("x", 0.5, "a"));
  cell->submit(move_to("x", -0.5, "b"));
  cell->submit(slide("x", -0.5, 0.3, 1.0, "c"));
  cell->run_to_the_end(at(20s));
  for (const char* key : {"a", "b", "c"}) EXPECT_EQ(cell->job(key).state, JobState::succeeded);
  expect_at(0.3, -1.0);
}

TEST_P(Goals, ThatCrossAreBothReachedWithoutContact) {
  cell->submit(move_to("x", 1.0, "x"));
  cell->submit(move_to("y", 1.0, "y"));
  cell->run_to_the_end(at(20s));
  expect_at(1.0, 1.0);
  EXPECT_GT(cell->log.closest_m, 0.0);
}

TEST_P(Goals, FailWithThePlannersReasonBehindAnObject) {
  ASSERT_TRUE(cell->simulation->executive().scene().add(box_at("post", 0.5, 0.0)));
  cell->submit(move_to("x", 0.5, "into it"));
  cell->run_to_the_end(at(10s));
  const JobView failed = cell->job("into it");
  EXPECT_EQ(failed.reason(), Reason::no_plan);
  EXPECT_NE(failed.detail().find("post"), std::string::npos) << failed.detail();
  expect_at(-1.0, -1.0);
}

// An object that touches the arm at its start does not make its goal unreachable. (An object that
// is even closer would be refused.)
TEST_P(Goals, WaitUntilAnObjectThatTouchesTheArmIsRemoved) {
  cell->submit(move_to("x", -0.8, "before"));
  cell->run_to_the_end(at(10s));
  ASSERT_TRUE(cell->simulation->executive().scene().add(box_at("hand", -0.8, 0.165)));
  cell->submit(move_to("x", 0.5, "first"));
  cell->submit(move_to("x", 0.25, "second"));
  cell->submit(move_to("y", 0.5, "of the other arm"));
  cell->run_until(cell->simulation->now() + 5s);
  const JobView waits = cell->job("first");
  EXPECT_EQ(waits.state, JobState::backlogged) << waits.detail();
  EXPECT_EQ(waits.motion.planned, false);
  ASSERT_EQ(waits.waits_on.size(), 1U);
  EXPECT_EQ(waits.waits_on[0].kind, Wait::Kind::object);
  ASSERT_EQ(waits.waits_on[0].links.size(), 2U);
  EXPECT_EQ(waits.waits_on[0].links[1], "hand");
  EXPECT_EQ(cell->job("second").state, JobState::queued);
  EXPECT_EQ(cell->job("of the other arm").state, JobState::succeeded);
  ASSERT_TRUE(cell->simulation->executive().scene().remove("hand"));
  cell->submit(move_to("y", -1.0, "out of the way"));
  cell->run_to_the_end(at(40s));
  for (const char* key : {"first", "second"}) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << cell->job(key).detail();
  }
  expect_at(0.25, -1.0);
}

TEST_P(Goals, ExpireIfAnObjectKeepsTouchingTheArm) {
  ASSERT_TRUE(cell->simulation->executive().scene().add(box_at("hand", -1.0, 0.165)));
  JobRequest goal = move_to("x", 0.5, "goal");
  goal.terms.backlog_timeout = 5s;
  cell->submit(goal);
  cell->run_until(at(4s));
  EXPECT_EQ(cell->job("goal").state, JobState::backlogged);
  cell->run_to_the_end(at(10s));
  EXPECT_EQ(cell->job("goal").reason(), Reason::backlog_timeout);
  EXPECT_LT(cell->simulation->now(), at(6s));
}

TEST_P(Goals, KeepWaitingThroughUnrelatedSceneChanges) {
  ASSERT_TRUE(cell->simulation->executive().scene().add(box_at("hand", -1.0, 0.165)));
  cell->submit(move_to("x", 0.5, "goal"));
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(cell->simulation->executive().scene().add(
        box_at("fly " + std::to_string(i), 3.0, 3.0 + i)));
    cell->run_until(cell->simulation->now() + 200ms);
  }
  EXPECT_EQ(cell->job("goal").state, JobState::backlogged) << cell->job("goal").detail();
  ASSERT_TRUE(cell->simulation->executive().scene().remove("hand"));
  cell->run_to_the_end(at(20s));
  EXPECT_EQ(cell->job("goal").state, JobState::succeeded) << cell->job("goal").detail();
}

// The first plan was made without the object; the second plan includes it.
TEST_P(Goals, AreReplannedIfTheSceneChanged) {
  cell->submit(move_to("x", 0.5, "late"));
  ASSERT_TRUE(cell->simulation->executive().scene().add(box_at("post", 0.5, 0.0)));
  cell->run_to_the_end(at(10s));
  EXPECT_EQ(cell->job("late").reason(), Reason::no_plan);
  expect_at(-1.0, -1.0);
}

TEST_P(Goals, AreReplannedIfTheStartChanged) {
  cell->submit(slide("x", -1, 0, 2, "first"));
  cell->submit(move_to("x", 0.5, "then"));
  cell->run_until(at(1s));
  ASSERT_TRUE(cell->simulation->executive().cancel("first"));
  cell->run_to_the_end(at(20s));
  EXPECT_EQ(cell->job("first").state, JobState::canceled);
  EXPECT_EQ(cell->job("then").state, JobState::succeeded) << cell->job("then").detail();
  expect_at(0.5, -1.0);
}

TEST_P(Goals, FailTheNextTrajectoryAtOnceIfTheyFail) {
  ASSERT_TRUE(cell->simulation->executive().scene().add(box_at("post", 0.5, 0.0)));
  cell->submit(move_to("x", 0.5, "fails"));
  cell->submit(slide("x", 0.5, 0.0, 1.0, "cannot begin"));
  cell->submit(move_to("x", 0.0, "begins anywhere"));
  cell->run_to_the_end(at(10s));
  EXPECT_EQ(cell->job("fails").reason(), Reason::no_plan);
  EXPECT_EQ(cell->job("cannot begin").reason(), Reason::start_mismatch);
  EXPECT_EQ(cell->job("begins anywhere").state, JobState::succeeded);
  expect_at(0.0, -1.0);
}

TEST_P(Goals, FailIfTheSceneChangesDuringEveryAttempt) {
  cell->submit(move_to("x", 0.5, "restless"));
  for (int i = 0; i < 20 && !cell->simulation->executive().all_ended(); ++i) {
    const std::string name = "fly " + std::to_string(i);
    ASSERT_TRUE(cell->simulation->executive().scene().add(box_at(name, 0.9, 0.9 + 0.01 * i)));
    cell->run_until(cell->simulation->now() + kSimulatedPlanning);
  }
  EXPECT_EQ(cell->job("restless").reason(), Reason::no_plan);
}

TEST_P(Goals, SucceedIfAlreadyReached) {
  cell->submit(move_to("x", -1.0, "here"));
  cell->run_to_the_end(at(10s));
  EXPECT_EQ(cell->job("here").state, JobState::succeeded) << cell->job("here").detail();
}

TEST_P(Goals, StayCanceledIfCanceledBeforeTheirPlan) {
  cell->submit(move_to("x", 0.5, "never"));
  ASSERT_TRUE(cell->simulation->executive().cancel("never"));
  cell->run_until(at(2s));
  EXPECT_EQ(cell->job("never").state, JobState::canceled);
  expect_at(-1.0, -1.0);
}

// Planning ignores an arm that could still leave. The job then waits for that arm, as a job with a
// trajectory does.
TEST_P(Goals, WaitForAnArmInTheirWay) {
  cell->submit(slide("y", -1, 0, 2, "in the way"));
  cell->run_until(at(3s));
  cell->submit(move_to("x", 0.5, "passes"));
  cell->run_until(at(6s));
  const JobView waits = cell->job("passes");
  EXPECT_EQ(waits.state, JobState::backlogged) << waits.detail();
  ASSERT_FALSE(waits.waits_on.empty());
  EXPECT_EQ(waits.waits_on[0].arm, "y");
  cell->submit(move_to("y", 1.0, "leaves"));
  cell->run_to_the_end(at(20s));
  EXPECT_EQ(cell->job("passes").state, JobState::succeeded);
  expect_at(0.5, 1.0);
}

TEST_P(Goals, ThatArePosesAreReachedAndTheNextJobCanStartThere) {
  JobRequest pose{.key = "pose", .name = "", .trajectory = {}};
  pose.arm = "x";
  pose.move_to = PlanGoal{.joints = {}, .named = {}, .pose = PlanPose{}};
  pose.move_to->pose->X_WL.translation().x() = 0.25;
  cell->submit(pose);
  cell->submit(slide("x", 0.25, 0.5, 1.0, "on"));
  cell->submit(slide("x", 0.5, 0.0, 1.0, "and back"));
  cell->run_to_the_end(at(20s));
  for (const char* key : {"pose", "on", "and back"}) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << cell->job(key).detail();
  }
  expect_at(0.0, -1.0);
}

TEST_P(Goals, AreRefusedAtOnceIfImpossible) {
  const auto refused = [&](JobRequest request, const std::string& pointer) {
    const auto answer = cell->simulation->executive().submit(std::move(request));
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().front().pointer, pointer) << answer.error().front().detail;
  };
  refused(move_to("z", 0.5, "a"), "/arm");
  refused(move_to("x", 7.0, "b"), "/move_to/joints/0");
  JobRequest named = move_to("x", 0.0, "c");
  named.move_to = PlanGoal{.joints = {}, .named = "nowhere", .pose = {}};
  refused(named, "/move_to/named");
  JobRequest any = move_to("x", 0.0, "d");
  any.terms.reorderable = true;
  refused(any, "/reorderable");
  JobRequest both = slide("x", -1, 0, 2, "e");
  both.arm = "y";
  refused(both, "/arm");
}

}  // namespace
}  // namespace armloom

// Jobs with "move_to_start": "plan": the server brings their arms to their start.
#include "core/scheduler/ways/approach.h"
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

JobRequest approached(JobRequest request) {
  request.terms.move_to_start = MoveToStart::plan;
  return request;
}

class MovesToStart : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { cell.emplace(gantries(OnIdleBlocker::report), GetParam()); }
  void expect_succeeded(const std::string& key) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << key << ": " << cell->job(key).detail();
  }
  std::optional<TwoGantries> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, MovesToStart, ::testing::ValuesIn(known_policies()));

TEST_P(MovesToStart, BringTheArmToTheStartFirstAndSlowly) {
  const JobRequest far = go("a", {-2, 1}, {-2, 2}, 20, "far");
  ASSERT_FALSE(cell->executive().submit(far)) << "without it that is refused";
  cell->submit(approached(far));
  cell->run_until(at(10ms));
  EXPECT_EQ(cell->job("move-to-start-1").name, "a moves to the start of far");
  EXPECT_EQ(cell->job("far").state, JobState::queued);
  cell->run_to_the_end();
  expect_succeeded("move-to-start-1");
  expect_succeeded("far");
  EXPECT_LE(cell->job("move-to-start-1").times.ended_at, cell->job("far").times.started_at);
  cell->expect_at("a", {-2, 2});
  EXPECT_GT(cell->fastest_m_s(), 0.1);
  EXPECT_LT(cell->fastest_m_s(), 2.0 * kApproachSpeed + 0.05);
}

TEST_P(MovesToStart, AreNotAddedIfTheArmIsAtTheStart) {
  cell->submit(approached(go("a", {-1, 0}, {-1, 1}, 3, "here")));
  cell->run_to_the_end();
  expect_succeeded("here");
  EXPECT_FALSE(cell->executive().job("move-to-start-1"));
}

TEST_P(MovesToStart, ServeAJobBehindACanceledJob) {
  cell->submit(go("a", {-1, 0}, {0, 2}, 6, "canceled"));
  cell->submit(approached(go("a", {0, 2}, {-1, 2}, 3, "then")));
  cell->run_until(at(3s));
  ASSERT_TRUE(cell->executive().cancel("canceled"));
  cell->run_to_the_end();
  expect_succeeded("then");
  expect_succeeded("move-to-start-1");
  cell->expect_at("a", {-1, 2});
}

TEST_P(MovesToStart, FailTheJobWithTheReasonIfThereIsNoPath) {
  cell->submit(approached(go("a", {1, 0}, {1, 2}, 6, "where b stands")));
  CollisionObject post{.name = "post", .shape = Box{{0.3, 0.3, 0.3}}};
  post.X_WO.translation() = Eigen::Vector3d(-2.0, 1.0, 0.0);
  ASSERT_TRUE(cell->executive().scene().add(std::move(post)));
  cell->submit(approached(go("a", {-2, 1}, {-2, 2}, 6, "in the post")));
  ASSERT_TRUE(cell->executive().cancel("where b stands"));
  cell->run_to_the_end();
  const JobView failed = cell->job("in the post");
  EXPECT_EQ(failed.reason(), Reason::start_mismatch);
  EXPECT_NE(failed.detail().find("no path to its start: "), std::string::npos) << failed.detail();
  EXPECT_NE(failed.detail().find("post"), std::string::npos) << failed.detail();
  cell->expect_at("a", {-1, 0});
}

TEST_P(MovesToStart, CostEachArmAtMostOneJobIfTheyBlockEachOther) {
  stop_all(cell->executive(), "test");
  for (int i = 0; i < 4; ++i) {
    const double y = 0.1 * i, on = y + 0.1;
    cell->submit(approached(go("a", {1, y}, {1, on}, 3, "a" + std::to_string(i))));
    cell->submit(approached(go("b", {-1, y}, {-1, on}, 3, "b" + std::to_string(i))));
  }
  resume_all(cell->executive());
  cell->run_until(at(20s));
  int lost = 0;
  for (const std::string arm : {"a", "b"}) {
    int of_arm = 0;
    for (int i = 0; i < 4; ++i) {
      const JobView job = cell->job(arm + std::to_string(i));
      if (job.state != JobState::failed) continue;
      EXPECT_EQ(job.reason(), Reason::deadlock) << job.key;
      EXPECT_FALSE(job.cycle.empty()) << job.key;
      ++of_arm;
    }
    EXPECT_LE(of_arm, 1) << arm;
    lost += of_arm;
  }
  EXPECT_GE(lost, 1);
}

TEST_P(MovesToStart, AreNotRetriedAfterTheBacklogTimeout) {
  JobRequest job = approached(go("a", {1, 0}, {1, 2}, 6, "where b stands"));
  job.terms.backlog_timeout = 5s;
  cell->submit(job);
  cell->run_to_the_end();
  EXPECT_EQ(cell->job("move-to-start-1").state, JobState::expired);
  EXPECT_FALSE(cell->executive().job("move-to-start-2"));
  const JobView failed = cell->job("where b stands");
  EXPECT_EQ(failed.reason(), Reason::start_mismatch);
  EXPECT_NE(failed.detail().find("no path to its start: waited 5 s"), std::string::npos)
      << failed.detail();
  EXPECT_LT(failed.times.ended_at, at(6s));
}

// The move-to-start was planned while b was elsewhere. Then b stops on that path.
TEST_P(MovesToStart, AreReplannedAroundAnArmThatStoppedOnThePath) {
  cell.emplace(gantries(OnIdleBlocker::replan), GetParam());
  cell->executive().stop({ArmId{0}}, "operator");
  cell->submit(approached(go("a", {-1, 2}, {-1, 3}, 6, "far")));
  cell->run_until(at(1s));
  ASSERT_EQ(cell->job("move-to-start-1").state, JobState::queued);
  cell->submit(go("b", {1, 0}, {-3, 2}, 6, "across it"));
  cell->run_until(at(4s));
  ASSERT_TRUE(cell->executive().cancel("across it"));
  cell->run_until(at(6s));
  const Configuration stands = cell->measured();
  ASSERT_NEAR(stands[2], -1.0, 0.15);
  ASSERT_NEAR(stands[3], 1.0, 0.15);
  cell->executive().resume({ArmId{0}});
  cell->run_to_the_end();
  expect_succeeded("far");
  expect_succeeded("move-to-start-1");
  cell->expect_at("b", {stands[2], stands[3]});  // b did not retreat
}

TEST_P(MovesToStart, AreCanceledWithTheirJob) {
  cell->submit(approached(go("a", {-2, 2}, {-2, 3}, 6, "gone")));
  cell->run_until(at(2s));
  ASSERT_EQ(cell->job("move-to-start-1").state, JobState::running);
  ASSERT_TRUE(cell->executive().cancel("gone"));
  cell->run_to_the_end(at(5s));
  EXPECT_EQ(cell->job("gone").state, JobState::canceled);
  EXPECT_EQ(cell->job("move-to-start-1").state, JobState::canceled);
}

TEST_P(MovesToStart, ContinueAfterStopAndResume) {
  cell->submit(approached(go("a", {-2, 2}, {-2, 3}, 6, "job")));
  cell->run_until(at(2s));
  stop_all(cell->executive(), "operator");
  cell->run_until(at(5s));
  EXPECT_EQ(cell->job("move-to-start-1").state, JobState::paused);
  resume_all(cell->executive());
  cell->run_to_the_end();
  expect_succeeded("job");
}

TEST_P(MovesToStart, AreRepeatedAfterAFault) {
  cell->submit(approached(go("a", {-2, 2}, {-2, 3}, 6, "job")));
  ASSERT_TRUE(cell->executive().faults().inject(
      {.arm = "a", .kind = ArmFault::Kind::fault, .at = at(2s), .lasting = {}}));
  cell->run_until(at(5s));
  EXPECT_EQ(cell->job("move-to-start-1").reason(), Reason::arm_fault);
  EXPECT_EQ(cell->job("job").state, JobState::queued);
  resume_all(cell->executive());
  cell->run_to_the_end();
  expect_succeeded("move-to-start-2");
  expect_succeeded("job");
}

TEST_P(MovesToStart, NeverTouchAnotherArm) {
  cell->submit(go("b", {1, 0}, {-3, 0}, 8, "b"));
  cell->submit(approached(go("a", {1, 1}, {1, 2}, 6, "a")));
  cell->run_to_the_end();
  expect_succeeded("a");
  EXPECT_GT(cell->closest_m(), 0.0);
}

TEST_P(MovesToStart, AreRefusedForGoals) {
  JobRequest goal{.key = "goal", .name = "", .trajectory = {}};
  goal.arm = "a";
  goal.move_to = PlanGoal{.joints = std::vector{0.0, 1.0}, .named = {}, .pose = {}};
  const auto refused = cell->executive().submit(approached(goal));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, "/move_to_start");
}

// If the arms would collide at the job's start itself, retreats cannot help, because the arms are
// not at that start yet.
TEST_P(MovesToStart, AreNotMadeForAJobWhoseArmsCollideAtTheStart) {
  for (const double b_x_m : {0.1, 0.21}) {
    SCOPED_TRACE("b at " + std::to_string(b_x_m));
    cell.emplace(gantries(OnIdleBlocker::park), GetParam());
    JobRequest both = approached(go("a", {0, 1}, {-1, 1}, 6, "both"));
    both.trajectory.joint_names = {"a_x", "a_y", "b_x", "b_y"};
    const std::vector<double> zero(4, 0.0);
    both.trajectory.points = {{{0, 1, b_x_m, 1}, zero, zero, 0.0},
                              {{-1, 1, 1, 1}, zero, zero, 6.0}};
    cell->submit(both);
    cell->run_to_the_end();
    EXPECT_EQ(cell->job("both").reason(), Reason::self_collision) << cell->job("both").detail();
    EXPECT_LE(cell->job("both").times.ended_at, at(100ms));
    EXPECT_FALSE(cell->executive().job("move-to-start-1"));
    cell->expect_at("a", {-1, 0});
    cell->expect_at("b", {1, 0});
  }
}

}  // namespace
}  // namespace armloom

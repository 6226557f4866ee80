#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

class Replans : public ::testing::TestWithParam<std::string> {
 protected:
  void start(OnIdleBlocker on_idle_blocker) { cell.emplace(gantries(on_idle_blocker), GetParam()); }
  void expect_succeeded(const std::string& key) {
    EXPECT_EQ(cell->job(key).state, JobState::succeeded) << key << ": " << cell->job(key).detail();
  }
  void expect_apart() const {
    const bool is_sampled = GetParam() == "timed_discrete";
    EXPECT_GT(cell->closest_m(), is_sampled ? 0.0 : 0.019);
  }
  std::optional<TwoGantries> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, Replans, ::testing::ValuesIn(known_policies()));

TEST_P(Replans, LeadAroundAnIdleArm) {
  start(OnIdleBlocker::replan);
  cell->submit(go("a", {-1, 0}, {2, 0}, 6, "past b"));
  cell->run_to_the_end();
  expect_succeeded("past b");
  const auto other = cell->job("past b").ways.another_way;
  ASSERT_TRUE(other);
  EXPECT_EQ(other->done, 1U);
  EXPECT_EQ(other->cause, AnotherWay::Cause::blocked);
  EXPECT_FALSE(other->is_open);
  cell->expect_at("a", {2, 0});
  cell->expect_at("b", {1, 0});
  expect_apart();
}

TEST_P(Replans, AreReplacedByARetreatIfThereIsNoDetour) {
  start(OnIdleBlocker::replan);
  cell->submit(go("b", {1, 0}, {0, 0}, 2, "b"));
  cell->run_until(at(3s));
  cell->submit(go("a", {-1, 0}, {0, 0}, 3, "into its place"));
  cell->run_to_the_end();
  expect_succeeded("into its place");
  expect_succeeded("retreat-1");
  const auto other = cell->job("into its place").ways.another_way;
  ASSERT_TRUE(other && other->refusal);
  EXPECT_EQ(other->done, 0U);
  EXPECT_NE(other->refusal->find("b_ball"), std::string::npos) << *other->refusal;
  expect_apart();
}

// b is at home and has not moved, so it has no straight retreat.
TEST_P(Replans, PlanARetreatIfNoStraightOneExists) {
  for (const auto how : {OnIdleBlocker::park, OnIdleBlocker::replan}) {
    start(how);
    JobRequest job = go("a", {-1, 0}, {1, 0}, 6, "into its home");
    job.terms.backlog_timeout = 5s;
    cell->submit(std::move(job));
    cell->run_to_the_end();
    if (how == OnIdleBlocker::park) {
      EXPECT_EQ(cell->job("into its home").state, JobState::expired);
      continue;
    }
    expect_succeeded("into its home");
    expect_succeeded("retreat-1");
    EXPECT_EQ(cell->job("retreat-1").name, "b retreats for into its home");
    cell->expect_at("a", {1, 0});
    expect_apart();
  }
}

// Each job passes the other arm's place; both goals are free.
TEST_P(Replans, ResolveADeadlock) {
  for (const auto how : {OnIdleBlocker::report, OnIdleBlocker::replan}) {
    start(how);
    cell->submit(go("a", {-1, 0}, {2, 0}, 6, "a"));
    cell->submit(go("b", {1, 0}, {-2, 0}, 6, "b"));
    cell->run_to_the_end(at(200s));
    if (how == OnIdleBlocker::report) {
      EXPECT_EQ(cell->job("b").reason(), Reason::deadlock);
      continue;
    }
    expect_succeeded("a");
    expect_succeeded("b");
    cell->expect_at("a", {2, 0});
    cell->expect_at("b", {-2, 0});
    expect_apart();
  }
}

TEST_P(Replans, ReplaceExpiryAfterTheBacklogTimeout) {
  start(OnIdleBlocker::report);
  JobRequest job = go("a", {-1, 0}, {2, 0}, 6, "late");
  job.terms.on_timeout = OnTimeout::replan;
  job.terms.backlog_timeout = 5s;
  cell->submit(std::move(job));
  cell->run_until(at(4s));
  EXPECT_EQ(cell->job("late").state, JobState::backlogged);
  EXPECT_FALSE(cell->job("late").ways.another_way);
  cell->run_to_the_end();
  expect_succeeded("late");
  EXPECT_EQ(cell->job("late").ways.another_way->cause, AnotherWay::Cause::timeout);
  EXPECT_GE(cell->job("late").times.started_at, at(5s));
  expect_apart();
}

TEST_P(Replans, LetTheJobExpireIfThereIsNoAlternativePath) {
  start(OnIdleBlocker::report);
  JobRequest job = go("a", {-1, 0}, {1, 0}, 6, "into b");
  job.terms.on_timeout = OnTimeout::replan;
  job.terms.backlog_timeout = 5s;
  cell->submit(std::move(job));
  cell->run_to_the_end(at(20s));
  const JobView expired = cell->job("into b");
  EXPECT_EQ(expired.state, JobState::expired);
  EXPECT_EQ(expired.reason(), Reason::backlog_timeout);
  EXPECT_EQ(expired.detail().rfind("waited 5 s in the backlog; no other path: ", 0), 0U)
      << expired.detail();
  cell->expect_at("a", {-1, 0});
}

TEST_P(Replans, BrakeAMovingJobAndContinueIt) {
  start(OnIdleBlocker::report);
  cell->submit(go("a", {-1, 0}, {0, 2}, 6, "moves"));
  cell->submit(go("a", {0, 2}, {-1, 2}, 2, "then"));
  cell->run_until(at(3s));
  const JobView before = cell->job("moves");
  ASSERT_EQ(before.state, JobState::running);
  const auto asked = cell->executive().replan("moves");
  ASSERT_TRUE(asked);
  EXPECT_TRUE(asked->ways.another_way->is_open);
  EXPECT_EQ(asked->id, before.id);
  cell->run_to_the_end();
  expect_succeeded("moves");
  expect_succeeded("then");
  EXPECT_EQ(cell->job("moves").ways.another_way->done, 1U);
  EXPECT_EQ(cell->job("moves").times.started_at, before.times.started_at) << "it has begun once";
  cell->expect_at("a", {-1, 2});
}

TEST_P(Replans, PreventAWaitingJobFromUsingItsOldPath) {
  start(OnIdleBlocker::report);
  cell->submit(go("a", {-1, 0}, {0, 2}, 6, "waits"));
  ASSERT_TRUE(cell->executive().replan("waits"));
  const JobView asked = cell->job("waits");
  ASSERT_FALSE(asked.waits_on.empty());
  EXPECT_EQ(asked.waits_on.front().kind, Wait::Kind::plan);
  cell->run_to_the_end();
  expect_succeeded("waits");
  EXPECT_EQ(cell->job("waits").ways.another_way->done, 1U);
  cell->expect_at("a", {0, 2});
}

TEST_P(Replans, LeadAroundANewObject) {
  start(OnIdleBlocker::report);
  cell->submit(go("a", {-1, 0}, {0, 2}, 6, "stopped"));
  cell->run_until(at(2s));
  CollisionObject post{.name = "post", .shape = Box{{0.1, 0.1, 0.1}}};
  post.X_WO.translation() = Eigen::Vector3d(-0.2, 1.6, 0.0);
  ASSERT_TRUE(cell->executive().scene().add(std::move(post)));
  cell->run_until(at(5s));
  ASSERT_EQ(cell->job("stopped").state, JobState::paused);
  ASSERT_TRUE(cell->executive().replan("stopped"));
  cell->run_to_the_end();
  expect_succeeded("stopped");
  cell->expect_at("a", {0, 2});
}

TEST_P(Replans, ContinueAStoppedJobAfterTheResume) {
  start(OnIdleBlocker::report);
  cell->submit(go("a", {-1, 0}, {0, 2}, 6, "stopped"));
  cell->run_until(at(2s));
  stop_all(cell->executive(), "operator");
  cell->run_until(at(3s));
  ASSERT_TRUE(cell->executive().replan("stopped"));
  cell->run_until(at(6s));
  EXPECT_FALSE(is_terminal(cell->job("stopped").state));
  EXPECT_EQ(cell->job("stopped").ways.another_way->done, 1U);
  resume_all(cell->executive());
  cell->run_to_the_end();
  expect_succeeded("stopped");
}

TEST_P(Replans, KeepTheOldPathIfThereIsNoAlternative) {
  start(OnIdleBlocker::report);
  cell->submit(go("a", {-1, 0}, {1, 0}, 6, "into b"));
  cell->run_until(at(1s));
  ASSERT_TRUE(cell->executive().replan("into b"));
  cell->run_until(at(2s));
  const JobView waits = cell->job("into b");
  EXPECT_EQ(waits.state, JobState::backlogged);
  EXPECT_TRUE(waits.ways.another_way->refusal);
  cell->submit(go("b", {1, 0}, {1, 1}, 2, "leaves"));
  cell->run_to_the_end();
  expect_succeeded("into b");
  expect_apart();
}

TEST_P(Replans, AreRefusedForLoopsAndEndedJobs) {
  start(OnIdleBlocker::report);
  JobRequest loop = go("a", {-1, 0}, {-1, 0}, 6, "loop");
  loop.trajectory.points[1].positions = {-1, 1};
  loop.trajectory.points.push_back(loop.trajectory.points.front());
  loop.trajectory.points.back().time_from_start_s = 12;
  cell->submit(std::move(loop));
  const auto refused = cell->executive().replan("loop");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().slug, "no-alternative-path");
  EXPECT_EQ(cell->executive().replan("nobody").error().front().kind, ProblemKind::not_found);
  cell->run_to_the_end();
  EXPECT_EQ(cell->executive().replan("loop").error().front().slug, "job-has-ended");
}

TEST_P(Replans, EndWithACancel) {
  start(OnIdleBlocker::report);
  cell->submit(go("a", {-1, 0}, {0, 2}, 6, "gone"));
  cell->run_until(at(3s));
  ASSERT_TRUE(cell->executive().replan("gone"));
  ASSERT_TRUE(cell->executive().cancel("gone"));
  cell->run_to_the_end();
  EXPECT_EQ(cell->job("gone").state, JobState::canceled);
}

}  // namespace
}  // namespace armloom

#include <gtest/gtest.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

TEST(Lockstep, StartsTheNextRoundWhenAllJobsHaveEnded) {
  Bench bench(2, "lockstep");
  const JobId left = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId right = bench.submit(move({1}, 0, 1, 3s), at(0ms));
  const JobId left_next = bench.submit(move({0}, 1, 0, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.answer_free(at(2ms));
  EXPECT_EQ(bench.state(left), JobState::scheduled);
  EXPECT_EQ(bench.state(right), JobState::scheduled);
  bench.progressed(left, 0ms, at(6ms));
  bench.progressed(right, 0ms, at(6ms));
  bench.finished(left, at(2s));
  EXPECT_FALSE(bench.question);  // the arm is free, but the round is not over
  ASSERT_EQ(bench.job(left_next).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(left_next).waits_on.front().kind, Wait::Kind::capacity);
  EXPECT_EQ(bench.job(left_next).waits_on.front().job, right);
  bench.finished(right, at(3s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, left_next);
}

TEST(Lockstep, ConflictingJobFollowsWithinTheRound) {
  Bench bench(2, "lockstep");
  const JobId left = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId right = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  const JobId left_next = bench.submit(move({0}, 1, 0, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.answer_conflict(at(2ms), Conflict::With::motion, left, ArmId{0});
  EXPECT_EQ(bench.state(right), JobState::backlogged);
  bench.progressed(left, 0ms, at(6ms));
  bench.finished(left, at(2s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, right);
  bench.answer_free(at(2001ms));
  EXPECT_EQ(bench.state(right), JobState::scheduled);
  EXPECT_EQ(bench.state(left_next), JobState::queued);
}

TEST(Lockstep, JobOfABlockingArmJoinsTheRound) {
  Bench bench(2, "lockstep");
  const JobId left = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.state(left), JobState::backlogged);
  const JobId right = bench.submit(move({1}, 0, 1, 2s), at(100ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, right);
}

// Planning may take long or fail.
TEST(Lockstep, UnplannedJobJoinsNoRound) {
  Bench bench(2, "lockstep");
  const JobId goal = bench.submit(Submit{.job = JobId{0},
                                         .trajectory = move({0}, 0, 1, 2s),
                                         .terms = {.backlog_timeout = 60s},
                                         .goals = {MotionGoal{ArmId{0}, Eigen::VectorXd::Ones(1)}}},
                                  at(0ms));
  const JobId right = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, right);
  bench.answer_free(at(1ms));
  EXPECT_EQ(bench.state(right), JobState::scheduled);
  ASSERT_EQ(bench.job(goal).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(goal).waits_on.front().kind, Wait::Kind::plan);
}

}  // namespace
}  // namespace armloom

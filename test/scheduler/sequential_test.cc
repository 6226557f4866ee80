#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

TEST(Sequential, RunsOneJobAtATimeInTheWholeCell) {
  Bench bench(2, "sequential");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.state(second), JobState::queued);
  ASSERT_EQ(bench.job(second).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(second).waits_on.front().kind, Wait::Kind::capacity);
  EXPECT_EQ(bench.job(second).waits_on.front().job, first);
  bench.finished(first, at(2s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, second);
}

TEST(Sequential, LetsTheBlockingArmGoFirst) {
  Bench bench(2, "sequential");
  const JobId blocked = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId leaves = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.state(blocked), JobState::backlogged);
  ASSERT_EQ(bench.question->candidates.front().step.job, leaves);
  bench.answer_free(at(2ms));
  bench.finished(leaves, at(2s));
  ASSERT_EQ(bench.question->candidates.front().step.job, blocked);
  bench.answer_free(at(2001ms));
  EXPECT_EQ(bench.state(blocked), JobState::scheduled);
}

TEST(Sequential, PausedJobKeepsTheCell) {
  Bench bench(2, "sequential");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(first, 500ms, at(503ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(503ms));
  bench.stopped(first, 600ms, at(700ms));
  EXPECT_EQ(bench.state(first), JobState::paused);
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.job(second).waits_on.front().kind, Wait::Kind::capacity);
}

}  // namespace
}  // namespace armloom

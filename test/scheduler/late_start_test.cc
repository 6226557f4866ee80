// Arms that do not begin when they should, and stops that come while a question is open.
#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::IsEmpty;

TEST(LateStart, IsNoticedWithoutAnyFeedback) {
  Bench bench(2, "certified");
  const JobId late = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId other = bench.submit(move({1}, 0, 1, 2s), at(2ms));
  bench.answer_free(at(3ms));
  bench.progressed(other, 0ms, at(5ms));
  const TimePoint noticed = at(kAllowanceMin) + bench.cell->checking.delay;
  ASSERT_TRUE(bench.wake_at);
  EXPECT_LE(*bench.wake_at, noticed + 1ns);
  bench.step(Wake{}, noticed);
  EXPECT_FALSE(bench.job(late).late) << "inside its band";
  bench.step(Wake{}, noticed + 1ns);
  EXPECT_TRUE(bench.job(late).late);
  ASSERT_TRUE(bench.question) << "the other one is judged again";
  ASSERT_EQ(bench.question->candidates.front().job, late);
  bench.answer_free(noticed + 1ms);
  ASSERT_EQ(bench.question->candidates.front().job, other);
  ASSERT_EQ(bench.question->others.size(), 1u);
  EXPECT_TRUE(bench.question->others.front().may_stand);
  EXPECT_LE(bench.question->others.front().progress, 2 * kAllowanceMin) << "it has not moved";
}

TEST(LateStart, OfAnArmThatThenMovesIsNoLossForgotten) {
  Bench bench(2, "certified");
  const JobId late = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(late, 0ms, at(150ms));  // 147 ms after its start
  EXPECT_EQ(bench.state(late), JobState::running);
  EXPECT_TRUE(bench.job(late).late);
  bench.answer_free(at(151ms));
  bench.progressed(late, kOnTimeAgain, at(150ms + kOnTimeAgain));
  EXPECT_FALSE(bench.job(late).late);
}

TEST(Stop, OfAnArmWhoseJobIsJustBeingJudgedStartsNothing) {
  for (const char* policy : {"timed_discrete", "certified", "earliest_start"}) {
    Bench bench(1, policy);
    const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
    ASSERT_TRUE(bench.question);
    bench.step(Stop{{ArmId{0}}, "operator"}, at(1ms));
    bench.answer_free(at(2ms));
    EXPECT_EQ(bench.state(job), JobState::queued);
    EXPECT_THAT(bench.dispatched, IsEmpty());
  }
}

}  // namespace
}  // namespace armloom

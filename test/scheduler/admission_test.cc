#include <gmock/gmock.h>

#include "core/coordination/effort.h"
#include "core/scheduler/scheduler.h"
#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

TEST(Admission,
     ReservesTheMotionInTheAdmittingStep) {  // T1: one runs, one waits
  Bench bench(2);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  ASSERT_EQ(bench.question->candidates.front().step.job, first);
  EXPECT_TRUE(bench.question->others.empty());

  bench.answer_free(at(1ms));
  EXPECT_EQ(bench.state(first), JobState::scheduled);
  // The next question already includes the first job's motion.
  ASSERT_EQ(bench.question->candidates.front().step.job, second);
  ASSERT_EQ(bench.question->others.size(), 1u);
  EXPECT_EQ(bench.question->others.front().step.job, first);

  bench.answer_conflict(at(2ms), Conflict::With::motion, first, ArmId{0});
  EXPECT_EQ(bench.state(second), JobState::backlogged);
  ASSERT_EQ(bench.job(second).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(second).waits_on.front().kind, Wait::Kind::job);
  EXPECT_EQ(bench.job(second).waits_on.front().job, first);
}

TEST(Admission, ChecksAStartOffThePathWithTheErrorsOfBothMeasurements) {
  const double error = one_joint_arms(1)->checking.tracking_error_rad;
  const auto asked = [](double off) {
    Bench bench(1);
    bench.submit(move({0}, off, 1, 2s), at(0ms));
    return bench.question->candidates.front().off_path;
  };
  EXPECT_EQ(asked(error), 0.0) << "the tracking error allows for it";
  EXPECT_NEAR(asked(3.0 * error), 5.0 * error, 1e-12);
}

TEST(Admission, ChecksAgainstMotionsFromTheirMeasuredProgress) {  // T2
  Bench bench(2);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(first, 1200ms, at(1250ms));
  bench.submit(move({1}, 0, 1, 2s), at(1300ms));
  EXPECT_EQ(bench.question->start_at, at(1300ms));
  EXPECT_EQ(bench.question->others.front().progress, 1200ms) << "measured, not expected";
  EXPECT_EQ(bench.question->candidates.front().progress, 0ms);
}

// For questions in a cell that already moves.
TEST(Admission, ChecksAgainstMotionsUnderWayFromTheirProgress) {
  const CellPtr cell = one_joint_arms(2);
  for (const Duration progress : {Duration{}, Duration{1200ms}}) {
    Scheduler scheduler(
        cell, *make_policy("certified", *cell), cell->home(),
        {{.step = StepId{JobId{1}}, .trajectory = move({0}, 0, 1, 2s), .progress = progress}},
        at(5s));
    EXPECT_EQ(scheduler.find(JobId{1})->state(),
              progress == Duration{} ? JobState::scheduled : JobState::running);
    const auto effects = scheduler.step(Submit{JobId{2}, move({1}, 0, 1, 2s), {0, 60s}}, at(5s));
    const auto judge = std::ranges::find_if(
        effects, [](const Effect& effect) { return std::holds_alternative<Judge>(effect); });
    ASSERT_NE(judge, effects.end());
    EXPECT_EQ(std::get<Judge>(*judge).question.others.front().progress, progress);
  }
}

TEST(Admission, ChecksAgainstAnUnstartedMotionFromItsStart) {
  Bench bench(2);
  bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  EXPECT_EQ(bench.question->others.front().progress, 0ms);
}

TEST(Admission, AcceptsALateAnswer) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(10s));
  EXPECT_EQ(bench.state(job), JobState::scheduled);
  ASSERT_EQ(bench.dispatched.size(), 1u);
  EXPECT_EQ(bench.dispatched.front().start_at, at(10s));
}

TEST(Admission, IgnoresAVerdictForAnOlderVersion) {
  Bench bench(2);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(100ms));
  const Version asked = bench.question->version;
  bench.finished(first, at(101ms));  // raises the version
  bench.step(Judged{Verdict{Verdict::Kind::free, asked, {}, {}, 1}}, at(102ms));
  EXPECT_EQ(bench.state(second), JobState::queued);
  EXPECT_GT(bench.question->version, asked);
}

TEST(Admission, DispatchesInTheAdmittingStep) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(5ms));
  bench.answer_free(at(6ms));
  ASSERT_EQ(bench.dispatched.size(), 1u);
  EXPECT_EQ(bench.dispatched.front().step.job, job);
  EXPECT_EQ(bench.dispatched.front().start_at, at(6ms));
  EXPECT_EQ(bench.dispatched.front().from_progress, 0ms);
  bench.progressed(job, 0ms, at(8ms));
  EXPECT_EQ(bench.state(job), JobState::running);
  EXPECT_EQ(bench.job(job).times.started_at, at(8ms));
}

TEST(Admission, ChecksTheLargerPriorityFirst) {
  Bench bench(3);
  bench.submit(move({0}, 0, 1, 2s), at(0ms));  // becomes the open question
  bench.submit(move({1}, 0, 1, 2s), at(0ms));
  const JobId urgent = bench.submit(move({2}, 0, 1, 2s), at(0ms), 60s, 5);
  bench.answer_free(at(1ms));
  EXPECT_EQ(bench.question->candidates.front().step.job, urgent);
}

TEST(Admission, RaisesAnExhaustedBudgetBeforeBacklogging) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  int now_ms = 1;
  for (std::uint64_t effort = 1; effort < kEffortMax; effort *= kEffortGrowth) {
    ASSERT_TRUE(bench.question);
    EXPECT_EQ(bench.question->effort, effort);
    bench.answer_exhausted(at(std::chrono::milliseconds(now_ms++)), Conflict::With::scene);
    EXPECT_EQ(bench.state(job), JobState::queued);
  }
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->effort, kEffortMax);
  bench.answer_exhausted(at(std::chrono::milliseconds(now_ms++)), Conflict::With::scene);
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.state(job), JobState::backlogged);
  EXPECT_FALSE(bench.job(job).waits_on.front().detail.empty());
}

TEST(Admission, ChecksOtherJobsBeforeRetryingWithARaisedBudget) {
  Bench bench(2);
  const JobId hard = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId other = bench.submit(move({1}, 0, 1, 2s), at(0ms));
  bench.answer_exhausted(at(1ms), Conflict::With::scene);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, other);
  EXPECT_EQ(bench.question->effort, 1U);
  bench.answer_free(at(2ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, hard);
  EXPECT_EQ(bench.question->effort, kEffortGrowth);
  bench.answer_free(at(3ms));
  EXPECT_EQ(bench.state(hard), JobState::scheduled);
}

TEST(Admission, FailsAJobThatCollidesWithItself) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::self);
  EXPECT_EQ(bench.state(job), JobState::failed);
  EXPECT_EQ(bench.job(job).reason(), Reason::self_collision);
  EXPECT_TRUE(bench.dispatched.empty());
}

}  // namespace
}  // namespace armloom

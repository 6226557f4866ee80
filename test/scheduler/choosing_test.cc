#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;

constexpr TimePoint kAged = TimePoint{} + 2min;  // longer than scheduling.aging

// The job whose turn it is waits for another arm, while the jobs behind it are free.
struct AnyOrder : ::testing::Test {
  AnyOrder() {
    moves = bench.submit(move({1}, 0, 1, 300s), at(0ms), 600s);
    bench.answer_free(at(1ms));
    turn = bench.submit(visit_from(0.0), at(2ms));
    bench.answer_conflict(at(3ms), Conflict::With::motion, moves, ArmId{1});
  }
  static Submit visit_from(double place, int priority = 0) {
    return {.job = JobId{0},
            .trajectory = visit(0, place, place + 0.5, 2s),
            .terms = {.priority = priority, .backlog_timeout = 600s, .reorderable = true}};
  }
  void expect_behind(JobId job, JobId before) {
    EXPECT_FALSE(bench.question) << "it is not its turn";
    EXPECT_EQ(bench.state(turn), JobState::backlogged);
    EXPECT_EQ(bench.state(job), JobState::queued);
    ASSERT_EQ(bench.job(job).waits_on.size(), 1u);
    EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::predecessor);
    EXPECT_EQ(bench.job(job).waits_on.front().job, before);
  }
  void answer_that_it_waits(TimePoint now) {
    ASSERT_TRUE(bench.question);
    ASSERT_EQ(bench.question->candidates.front().step.job, turn);
    bench.answer_conflict(now, Conflict::With::motion, moves, ArmId{1});
  }

  Bench bench{2};
  JobId moves{0}, turn{0};
};

TEST_F(AnyOrder, FreeJobOvertakesABlockedJob) {
  const JobId other = bench.submit(visit_from(0.0), at(4ms));
  answer_that_it_waits(at(5ms));
  bench.answer_free(at(6ms));
  EXPECT_EQ(bench.state(other), JobState::scheduled);
  ASSERT_TRUE(bench.job(other).choice);
  EXPECT_THAT(bench.job(other).choice->jobs, ElementsAre(turn, other));
}

// Only jobs of equal priority may be exchanged.
TEST_F(AnyOrder, JobOfAnotherPriorityDoesNotOvertake) {
  const JobId more = bench.submit(visit_from(0.0, 1), at(4ms));
  expect_behind(more, turn);
  expect_behind(bench.submit(visit_from(0.0, -1), at(5ms)), more);
}

TEST_F(AnyOrder, JobWithAnotherStartDoesNotOvertake) {
  expect_behind(bench.submit(visit_from(0.7), at(4ms)), turn);
}

TEST_F(AnyOrder, AgedJobIsNotOvertaken) {
  ASSERT_LT(TimePoint{} + bench.cell->scheduling.aging, kAged);
  const JobId other = bench.submit(visit_from(0.0), at(4ms));
  answer_that_it_waits(at(5ms));
  bench.answer_free(at(6ms));
  ASSERT_EQ(bench.state(other), JobState::scheduled);
  bench.progressed(other, 1s, at(2s));
  bench.finished(other, kAged);
  answer_that_it_waits(kAged + 1ms);
  expect_behind(bench.submit(visit_from(0.0), kAged + 2ms), turn);
}

// Jobs whose order is still open are not admitted before their turn.
struct AheadOfTheirTurns : ::testing::Test {
  void submit_three(bool reorderable) {
    for (JobId& job : jobs) {
      Submit visit = AnyOrder::visit_from(0.0);
      visit.terms.reorderable = reorderable;
      job = bench.submit(std::move(visit), now += 1ms);
    }
    while (bench.question) bench.answer_free(now += 1ms);
  }

  static CellPtr cell_that_looks_ahead() {
    auto cell = std::make_shared<Cell>(*one_joint_arms(2));
    cell->scheduling.horizon_steps = 3;
    return cell;
  }

  Bench bench{cell_that_looks_ahead(), "coordinated"};
  JobId jobs[3] = {JobId{0}, JobId{0}, JobId{0}};
  TimePoint now = at(0ms);
};

TEST_F(AheadOfTheirTurns, JobsInGivenOrderAreAdmittedTogether) {
  submit_three(false);
  for (const JobId job : jobs) EXPECT_EQ(bench.state(job), JobState::scheduled);
}

TEST_F(AheadOfTheirTurns, JobsInAnyOrderAreLeftOpenUntilOneMustStart) {
  submit_three(true);
  EXPECT_EQ(bench.state(jobs[0]), JobState::scheduled);
  EXPECT_EQ(bench.state(jobs[2]), JobState::queued);
  bench.progressed(jobs[0], 1s, now += 1s);
  bench.finished(jobs[0], now += 1s);
  while (bench.question) bench.answer_free(now += 1ms);
  for (const JobId job : {jobs[1], jobs[2]}) {
    EXPECT_EQ(bench.state(job), JobState::scheduled) << "no job is left to exchange with";
  }
}

}  // namespace
}  // namespace armloom

// Which of several jobs of an arm that may be taken in any order takes a turn.
#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;

constexpr TimePoint kAged = TimePoint{} + 2min;  // longer than scheduling.aging

// The job whose turn it is waits for another arm's motion; those behind it find their way free.
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
            .terms = {.priority = priority, .backlog_timeout = 600s, .order = JobOrder::any}};
  }
  void expect_behind(JobId job, JobId before) {
    EXPECT_FALSE(bench.question) << "it is not its turn";
    EXPECT_EQ(bench.state(turn), JobState::backlogged);
    EXPECT_EQ(bench.state(job), JobState::queued);
    ASSERT_EQ(bench.job(job).waits_on.size(), 1u);
    EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::order);
    EXPECT_EQ(bench.job(job).waits_on.front().job, before);
  }
  // That turn is asked about first, and still has to wait.
  void answer_that_it_waits(TimePoint now) {
    ASSERT_TRUE(bench.question);
    ASSERT_EQ(bench.question->candidates.front().job, turn);
    bench.answer_conflict(now, Conflict::With::motion, moves, ArmId{1});
  }

  Bench bench{2};
  JobId moves{0}, turn{0};
};

TEST_F(AnyOrder, OneThatCanGoTakesTheTurnOfOneThatCannot) {
  const JobId other = bench.submit(visit_from(0.0), at(4ms));
  answer_that_it_waits(at(5ms));
  bench.answer_free(at(6ms));
  EXPECT_EQ(bench.state(other), JobState::scheduled);
  ASSERT_TRUE(bench.job(other).choice);
  EXPECT_THAT(bench.job(other).choice->jobs, ElementsAre(turn, other));
}

// Whoever is to hurry is told by its priority, and so is who is not to.
TEST_F(AnyOrder, OneOfAnotherPriorityDoesNot) {
  const JobId more = bench.submit(visit_from(0.0, 1), at(4ms));
  expect_behind(more, turn);
  expect_behind(bench.submit(visit_from(0.0, -1), at(5ms)), more);
}

TEST_F(AnyOrder, OneThatBeginsElsewhereDoesNot) {
  expect_behind(bench.submit(visit_from(0.7), at(4ms)), turn);
}

TEST_F(AnyOrder, WhoHasBeenOvertakenForLongIsOvertakenNoMore) {
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

}  // namespace
}  // namespace armloom

#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A bench on which `count` jobs, one for each arm, are running.
struct Running : Bench {
  explicit Running(std::size_t count) : Bench(count) {
    for (std::size_t i = 0; i < count; ++i) {
      jobs.push_back(submit(move({static_cast<std::uint32_t>(i)}, 0, 1, 2s), at(0ms)));
    }
    for (std::size_t i = 0; i < count; ++i) answer_free(at(1ms));
    for (JobId job : jobs) progressed(job, 0ms, at(4ms));
  }
  std::vector<JobId> jobs;
};

TEST(Cancel, OfAWaitingJobEndsItAtOnce) {
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId behind = bench.submit(move({0}, 1, 0, 2s), at(0ms));
  bench.step(Cancel{behind}, at(1ms));
  EXPECT_EQ(bench.state(behind), JobState::canceled);
  EXPECT_EQ(bench.terminal_events[behind], 1);
  EXPECT_EQ(bench.state(first), JobState::queued);
}

TEST(Cancel, OfAMotionBrakesItAndShrinksItsReservationToWhereItStands) {  // T7
  Running bench(2);
  const auto [first, second] = std::tie(bench.jobs[0], bench.jobs[1]);
  bench.progressed(first, 800ms, at(803ms));
  bench.progressed(second, 800ms, at(803ms));
  bench.step(Cancel{first}, at(803ms));
  EXPECT_THAT(bench.braked, ElementsAre(first));
  EXPECT_TRUE(bench.job(first).stopping);
  EXPECT_EQ(bench.state(first), JobState::running);
  EXPECT_FALSE(bench.question) << "while it brakes, where it will rest is not known";

  bench.stopped(first, 1s, at(1100ms));
  EXPECT_EQ(bench.state(first), JobState::canceled);
  EXPECT_THAT(bench.released, ElementsAre(first));
  // The other is judged again beside the arm where it now rests, and goes on.
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().job, second);
  EXPECT_THAT(bench.question->others, IsEmpty());
  EXPECT_NEAR(bench.question->rest[0], 0.5, 1e-9);
  bench.answer_free(at(1101ms));
  EXPECT_EQ(bench.state(second), JobState::running);
  EXPECT_THAT(bench.braked, ElementsAre(first));
  EXPECT_FALSE(bench.question);
}

TEST(Cancel, HoldsOnlyWhatTheRestingArmStandsInTheWayOf) {
  Running bench(3);
  bench.step(Cancel{bench.jobs[0]}, at(500ms));
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  ASSERT_EQ(bench.question->candidates.front().job, bench.jobs[1]);
  bench.answer_conflict(at(701ms), Conflict::With::rest, {}, ArmId{0});
  EXPECT_THAT(bench.braked, ElementsAre(bench.jobs[0], bench.jobs[1]));
  EXPECT_EQ(bench.state(bench.jobs[1]), JobState::holding);
  EXPECT_EQ(bench.job(bench.jobs[1]).waits_on.front().arm, ArmId{0});
  bench.stopped(bench.jobs[1], 800ms, at(900ms));
  ASSERT_EQ(bench.question->candidates.front().job, bench.jobs[2]);
  bench.answer_free(at(901ms));
  EXPECT_EQ(bench.state(bench.jobs[2]), JobState::running);
  // The held one is tried as a candidate, from where it stands.
  ASSERT_EQ(bench.question->candidates.front().job, bench.jobs[1]);
  EXPECT_EQ(bench.question->candidates.front().progress, 800ms);
}

TEST(Cancel, BeforeTheFirstMotionMovesNothing) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Cancel{job}, at(2ms));
  EXPECT_THAT(bench.braked, ElementsAre(job));
  bench.stopped(job, 0ms, at(3ms));
  EXPECT_EQ(bench.state(job), JobState::canceled);
  EXPECT_EQ(bench.terminal_events[job], 1);
}

TEST(Stop, HoldsMotionsAndKeepsTheQueue) {
  Running bench(1);
  const JobId waits = bench.submit(move({0}, 1, 0, 2s), at(100ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(500ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::holding);
  EXPECT_TRUE(bench.job(bench.jobs[0]).stopping);
  bench.stopped(bench.jobs[0], 700ms, at(800ms));
  EXPECT_FALSE(bench.job(bench.jobs[0]).stopping);
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().kind, Wait::Kind::stop);
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().detail, "operator");
  EXPECT_EQ(bench.job(waits).waits_on.front().kind, Wait::Kind::order);
  EXPECT_FALSE(bench.question);

  bench.step(Resume{{ArmId{0}}}, at(5s));
  ASSERT_TRUE(bench.question);
  bench.answer_free(at(5001ms));
  EXPECT_EQ(bench.dispatched.back().from_progress, 700ms);
  bench.progressed(bench.jobs[0], 710ms, at(5010ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::running);
  EXPECT_EQ(bench.job(bench.jobs[0]).started_at, at(4ms)) << "it has started once";
  bench.finished(bench.jobs[0], at(7s));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::succeeded);
  EXPECT_EQ(bench.question->candidates.front().job, waits);
}

TEST(Stop, OfOneArmLeavesTheOthersTheirs) {
  Running bench(2);
  bench.step(Stop{{ArmId{0}}, "monitor"}, at(500ms));
  EXPECT_THAT(bench.braked, ElementsAre(bench.jobs[0]));
  EXPECT_EQ(bench.state(bench.jobs[1]), JobState::running);
}

TEST(Stop, BeforeTheFirstMotionPutsTheJobBackInTheQueue) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(2ms));
  bench.stopped(job, 0ms, at(3ms));
  EXPECT_EQ(bench.state(job), JobState::queued);
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::stop);
  bench.step(Resume{{ArmId{0}}}, at(1s));
  bench.answer_free(at(1001ms));
  EXPECT_EQ(bench.state(job), JobState::scheduled);
}

TEST(Stop, ACancelDuringTheBrakeWins) {
  Running bench(1);
  bench.step(Stop{{ArmId{0}}, "operator"}, at(500ms));
  bench.step(Cancel{bench.jobs[0]}, at(510ms));
  EXPECT_THAT(bench.braked, ElementsAre(bench.jobs[0])) << "it brakes once";
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::canceled);
}

TEST(Resume, TriesHeldMotionsTogetherFirstThenOneByOne) {
  Running bench(2);
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(500ms));
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  bench.stopped(bench.jobs[1], 610ms, at(710ms));
  bench.step(Resume{{ArmId{0}, ArmId{1}}}, at(1s));
  ASSERT_EQ(bench.question->candidates.size(), 2u);
  bench.answer_conflict(at(1001ms), Conflict::With::motion, bench.jobs[1], ArmId{1});
  ASSERT_TRUE(bench.question);
  ASSERT_EQ(bench.question->candidates.size(), 1u);
  EXPECT_EQ(bench.question->candidates.front().job, bench.jobs[0]);
  EXPECT_THAT(bench.question->others, IsEmpty());
  bench.answer_free(at(1002ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::scheduled);
  EXPECT_EQ(bench.question->candidates.front().job, bench.jobs[1]);
}

TEST(Interrupt, EndsEveryJobOnce) {
  Running bench(2);
  const JobId waits = bench.submit(move({0}, 1, 0, 2s), at(100ms));
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "the server ends"}, at(500ms));
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().detail, "the server ends") << "while braking";
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  bench.stopped(bench.jobs[1], 600ms, at(700ms));
  bench.step(Interrupt{}, at(701ms));
  for (JobId job : {bench.jobs[0], bench.jobs[1], waits}) {
    EXPECT_EQ(bench.state(job), JobState::interrupted);
    EXPECT_EQ(bench.job(job).reason, Reason::server_restart);
    EXPECT_EQ(bench.terminal_events[job], 1);
  }
}

TEST(Fault, FailsTheJobAndStopsItsArmUntilResumed) {
  Running bench(2);
  bench.step(MotionReport{bench.jobs[0], MotionReport::Kind::faulted, 500ms,
                          Eigen::VectorXd::Constant(1, 0.2), "drive 3"},
             at(503ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::failed);
  EXPECT_EQ(bench.job(bench.jobs[0]).reason, Reason::arm_fault);
  EXPECT_TRUE(bench.scheduler.stopped(ArmId{0}));
  EXPECT_EQ(bench.state(bench.jobs[1]), JobState::running);
  EXPECT_EQ(bench.question->candidates.front().job, bench.jobs[1]) << "judged beside the rest";
}

}  // namespace
}  // namespace armloom

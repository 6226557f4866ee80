#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::ElementsAre;

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

TEST(Cancel, EndsAWaitingJobAtOnce) {
  Bench bench(1);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  const JobId behind = bench.submit(move({0}, 1, 0, 2s), at(0ms));
  bench.step(Cancel{behind}, at(1ms));
  EXPECT_EQ(bench.state(behind), JobState::canceled);
  EXPECT_EQ(bench.terminal_events[behind], 1);
  EXPECT_EQ(bench.state(first), JobState::queued);
}

TEST(Cancel, BrakesOnlyTheCanceledMotion) {  // T7
  Running bench(2);
  const auto [first, second] = std::tie(bench.jobs[0], bench.jobs[1]);
  bench.progressed(first, 800ms, at(803ms));
  bench.progressed(second, 800ms, at(803ms));
  bench.step(Cancel{first}, at(803ms));
  EXPECT_THAT(bench.braked, ElementsAre(first));
  EXPECT_TRUE(bench.job(first).stopping());
  EXPECT_EQ(bench.state(first), JobState::running);
  bench.stopped(first, 1s, at(1100ms));
  EXPECT_EQ(bench.state(first), JobState::canceled);
  EXPECT_THAT(bench.released, ElementsAre(first));
  EXPECT_EQ(bench.state(second), JobState::running);
  EXPECT_THAT(bench.braked, ElementsAre(first));
}

TEST(Cancel, LaterChecksSeeTheArmAtItsRest) {
  Running bench(3);
  bench.step(Cancel{bench.jobs[0]}, at(803ms));
  bench.stopped(bench.jobs[0], 1s, at(1100ms));
  bench.finished(bench.jobs[2], at(2s));
  bench.submit(move({2}, 1, 0, 2s), at(3s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->others.size(), 1u) << "it has no reservation any more";
  EXPECT_NEAR(bench.question->rest[0], 0.5, 1e-9);
}

// The canceled arm rests in the way of one of two other motions.
TEST(Cancel, BlocksOnlyMotionsThatPassTheRestingArm) {
  Bench bench(3, "certified");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(first, 1s, at(1001ms));
  const JobId behind = bench.submit(move({1}, 0, 1, 2s), at(1002ms));
  bench.answer_regions(
      at(1003ms),
      {{only_step(behind), only_step(first), {region(ProgressBox{1500ms, 1800ms, 0ms, 1200ms})}}});
  const JobId free = bench.submit(move({2}, 0, 1, 2s), at(1002ms + 2ms));
  bench.answer_regions(
      at(1005ms),
      {{only_step(free), only_step(first), {region(ProgressBox{1500ms, 1800ms, 1900ms, 1950ms})}}});
  for (const JobId job : {behind, free}) bench.progressed(job, 0ms, at(1006ms));
  bench.step(Cancel{first}, at(1007ms));
  bench.stopped(first, 1100ms, at(1107ms));
  EXPECT_THAT(bench.braked, ElementsAre(first)) << "no arm brakes for it";
  bench.progressed(behind, 900ms, at(2s));
  bench.progressed(behind, 1400ms, at(3s));
  for (const auto now : {4s, 5s}) bench.progressed(behind, 1500ms - kShortOf, at(now));
  EXPECT_TRUE(bench.job(behind).pausing());
  EXPECT_EQ(bench.job(behind).waits_on.front().kind, Wait::Kind::arm);
  EXPECT_EQ(bench.job(behind).waits_on.front().arm, ArmId{0});
  EXPECT_EQ(bench.authority(behind), 1500ms - kShortOf);
  bench.progressed(free, 1500ms, at(5s));
  EXPECT_GT(bench.authority(free), 1500ms);
  EXPECT_FALSE(bench.job(free).pausing());
}

// Only a client's decision could let the waiting job continue.
TEST(Cancel, PermanentlyBlockedJobOnItsPathExpires) {
  Bench bench(2, "certified");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(first, 1s, at(1001ms));
  const JobId behind = bench.submit(move({1}, 0, 1, 2s), at(1002ms), 20s);
  bench.answer_regions(
      at(1003ms),
      {{only_step(behind), only_step(first), {region(ProgressBox{1500ms, 1800ms, 0ms, 1200ms})}}});
  bench.progressed(behind, 0ms, at(1006ms));
  bench.step(Cancel{first}, at(1007ms));
  bench.stopped(first, 1100ms, at(1107ms));
  bench.progressed(behind, 900ms, at(2s));
  for (Duration t = 3s; t < 24s; t += 1s) bench.progressed(behind, 1500ms - kShortOf, at(t));
  ASSERT_TRUE(bench.job(behind).pausing());
  bench.step(Wake{}, at(24s) - 1ns);
  EXPECT_THAT(bench.braked, ElementsAre(first));
  bench.step(Wake{}, at(24s));
  EXPECT_THAT(bench.braked, ElementsAre(first, behind)) << "it has stood there since 4 s";
  EXPECT_EQ(bench.state(behind), JobState::paused) << "it brakes where it rests";
  bench.stopped(behind, 1450ms, at(24100ms));
  EXPECT_EQ(bench.state(behind), JobState::expired);
  EXPECT_EQ(bench.job(behind).reason(), Reason::backlog_timeout);
  EXPECT_EQ(bench.job(behind).detail(), "waited 20 s on its path");
}

// x, y and z move their arm out of b's way only if all three are done.
TEST(Cancel, UnadmitsJobsBehindTheCanceledJob) {
  Bench bench(2, "coordinated");
  const JobId x = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId y = bench.submit(move({0}, 1, 0.5, 2s), at(2ms));
  const JobId z = bench.submit(move({0}, 0.5, 0, 2s), at(2ms));
  const JobId b = bench.submit(move({1}, 0, 1, 2s), at(2ms));
  bench.progressed(x, 1900ms, at(3ms));
  std::vector<PairRegions> regions{
      {only_step(b), only_step(x), {region(ProgressBox{1s, 1200ms, 1900ms, 2s})}}};
  bench.answer_regions(at(4ms), regions);
  regions.push_back({only_step(b), only_step(y), {region(ProgressBox{1s, 1200ms, 0s, 2s})}});
  bench.answer_regions(at(5ms), regions);
  ASSERT_EQ(bench.question->candidates.size(), 3u);
  regions.push_back({only_step(b), only_step(z), {region(ProgressBox{1s, 1200ms, 0s, 200ms})}});
  bench.answer_regions(at(6ms), regions);
  ASSERT_EQ(bench.state(z), JobState::scheduled);
  bench.step(Cancel{y}, at(7ms));
  EXPECT_EQ(bench.state(y), JobState::canceled);
  EXPECT_EQ(bench.state(z), JobState::queued) << "it begins where y would have ended";
  EXPECT_EQ(bench.state(b), JobState::scheduled);
}

TEST(Cancel, BeforeTheStartMovesNothing) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Cancel{job}, at(2ms));
  EXPECT_THAT(bench.braked, ElementsAre(job));
  bench.stopped(job, 0ms, at(3ms));
  EXPECT_EQ(bench.state(job), JobState::canceled);
  EXPECT_EQ(bench.terminal_events[job], 1);
}

TEST(Stop, PausesMotionsAndKeepsTheQueue) {
  Running bench(1);
  const JobId waits = bench.submit(move({0}, 1, 0, 2s), at(100ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(500ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::paused);
  EXPECT_TRUE(bench.job(bench.jobs[0]).stopping());
  bench.stopped(bench.jobs[0], 700ms, at(800ms));
  EXPECT_FALSE(bench.job(bench.jobs[0]).stopping());
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().kind, Wait::Kind::stop);
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().detail, "operator");
  EXPECT_EQ(bench.job(waits).waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_FALSE(bench.question);

  bench.step(Resume{{ArmId{0}}}, at(5s));
  ASSERT_TRUE(bench.question);
  bench.answer_free(at(5001ms));
  EXPECT_EQ(bench.dispatched.back().from_progress, 700ms);
  bench.progressed(bench.jobs[0], 710ms, at(5010ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::running);
  EXPECT_EQ(bench.job(bench.jobs[0]).times.started_at, at(4ms)) << "it has started once";
  bench.finished(bench.jobs[0], at(7s));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::succeeded);
  EXPECT_EQ(bench.question->candidates.front().step.job, waits);
}

TEST(Stop, AffectsOnlyTheStoppedArm) {
  Running bench(2);
  bench.step(Stop{{ArmId{0}}, "monitor"}, at(500ms));
  EXPECT_THAT(bench.braked, ElementsAre(bench.jobs[0]));
  EXPECT_EQ(bench.state(bench.jobs[1]), JobState::running);
}

TEST(Stop, BeforeTheStartKeepsTheJobAdmitted) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(2ms));
  bench.stopped(job, 0ms, at(3ms));
  EXPECT_EQ(bench.state(job), JobState::scheduled);
  EXPECT_THAT(bench.released, ElementsAre(job));
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::stop);
  bench.step(Resume{{ArmId{0}}}, at(1s));
  ASSERT_EQ(bench.dispatched.size(), 2u);
  EXPECT_EQ(bench.dispatched.back().step.job, job);
  EXPECT_EQ(bench.dispatched.back().from_progress, 0ms);
}

TEST(Stop, CancelDuringTheBrakeWins) {
  Running bench(1);
  bench.step(Stop{{ArmId{0}}, "operator"}, at(500ms));
  bench.step(Cancel{bench.jobs[0]}, at(510ms));
  EXPECT_THAT(bench.braked, ElementsAre(bench.jobs[0])) << "it brakes once";
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::canceled);
}

TEST(Stop, CancelSurvivesARequestForANewPathDuringTheBrake) {
  Running bench(1);
  bench.step(Cancel{bench.jobs[0]}, at(500ms));
  bench.step(Replan{bench.jobs[0]}, at(510ms));
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::canceled);
}

// The arm at rest has taken an object into its hand.
TEST(Stop, StopsAMotionInWhosePathAnArmRestsAfterAChangeOfTheScene) {
  Running bench(1);
  bench.step(SceneChanged{{ArmId{0}}}, at(510ms));
  bench.answer_regions(
      at(511ms),
      {{only_step(bench.jobs[0]), ArmId{1}, {region(ProgressBox{800ms, 900ms, 0ms, 0ms})}}});
  EXPECT_THAT(bench.braked, ElementsAre(bench.jobs[0]));
  ASSERT_EQ(bench.job(bench.jobs[0]).waits_on.size(), 1U);
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().arm, ArmId{1});
}

TEST(Resume, ContinuesPausedJobsInTheirPassingOrder) {
  OneBehindAnother two(ProgressBox{1s, 1500ms, 0ms, 1200ms});
  Bench& bench = two.bench;
  const JobId first = two.first, second = two.second;
  bench.progressed(second, 0ms, at(504ms));
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(510ms));
  bench.stopped(first, 600ms, at(700ms));
  bench.stopped(second, 100ms, at(710ms));
  bench.step(Resume{{ArmId{0}, ArmId{1}}}, at(1s));
  for (const JobId job : {first, second}) {
    ASSERT_TRUE(bench.question);
    ASSERT_EQ(bench.question->candidates.size(), 1u);
    EXPECT_EQ(bench.question->candidates.front().step.job, job);
    EXPECT_EQ(bench.question->others.size(), 1u) << "the other job's motion is still admitted";
    bench.answer_free(at(1001ms));
    EXPECT_EQ(bench.state(job), JobState::scheduled);
    EXPECT_EQ(bench.dispatched.back().step.job, job);
  }
  EXPECT_EQ(bench.dispatched.back().from_progress, 100ms);
  bench.progressed(second, 900ms, at(3s));
  EXPECT_EQ(bench.authority(second), 1s - kShortOf) << "the first one has not passed";
  bench.progressed(first, 1200ms, at(4s));
  EXPECT_GT(bench.authority(second), 1s);
}

TEST(Resume, DoesNotContinueAPausedJobIntoARestingArm) {
  Running bench(1);
  bench.step(Stop{{ArmId{0}}, "operator"}, at(500ms));
  bench.stopped(bench.jobs[0], 600ms, at(700ms));
  bench.step(Resume{{ArmId{0}}}, at(1s));
  bench.answer_regions(
      at(1001ms), {{only_step(bench.jobs[0]), ArmId{0}, {region(ProgressBox{1s, 2s, 0s, 0s})}}});
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::paused);
  EXPECT_EQ(bench.job(bench.jobs[0]).waits_on.front().kind, Wait::Kind::arm);
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
    EXPECT_EQ(bench.job(job).reason(), Reason::server_restart);
    EXPECT_EQ(bench.terminal_events[job], 1);
  }
}

TEST(Fault, FailsTheJobAndStopsItsArmUntilResumed) {
  Running bench(2);
  bench.step(MotionReport{only_step(bench.jobs[0]), MotionReport::Kind::faulted, 500ms,
                          Eigen::VectorXd::Constant(1, 0.2), "drive 3"},
             at(503ms));
  EXPECT_EQ(bench.state(bench.jobs[0]), JobState::failed);
  EXPECT_EQ(bench.job(bench.jobs[0]).reason(), Reason::arm_fault);
  EXPECT_TRUE(bench.scheduler.stopped(ArmId{0}));
  EXPECT_EQ(bench.state(bench.jobs[1]), JobState::running);
  const JobId next = bench.submit(move({0}, 0.2, 0, 2s), at(600ms));
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.job(next).waits_on.front().kind, Wait::Kind::stop);
  bench.step(Resume{{ArmId{0}}}, at(700ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, next);
}

}  // namespace
}  // namespace armloom

#include <gmock/gmock.h>

#include "core/model/promises.h"
#include "test/scheduler/bench_cell.h"
#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

CellPtr cell_with_horizon(std::size_t arms, int legs) {
  auto cell = std::make_shared<Cell>(*one_joint_arms(arms));
  cell->scheduling.horizon_steps = legs;
  return cell;
}

struct Horizon : ::testing::Test {
  Bench bench{cell_with_horizon(2, 3), "coordinated"};
  TimePoint now{};

  void answer_all_free() {
    while (bench.question) bench.answer_free(now += 1ms);
  }
  std::vector<JobId> submit_legs(std::uint32_t arm, std::size_t count) {
    std::vector<JobId> jobs;
    for (std::size_t i = 0; i < count; ++i) {
      const double from = i % 2 == 0 ? 0.0 : 1.0;
      jobs.push_back(bench.submit(move({arm}, from, 1.0 - from, 2s), now += 1ms));
    }
    return jobs;
  }
  // Two motions that meet from 4 to 4.2 s of both; the first has started.
  std::pair<JobId, JobId> meet() {
    const JobId first = bench.submit(move({0}, 0, 1, 6s), now += 1ms);
    answer_all_free();
    bench.progressed(first, 400ms, now += 400ms);
    const JobId second = bench.submit(move({1}, 0, 1, 6s), now += 1ms);
    bench.answer_regions(
        now += 1ms,
        {{only_step(second), only_step(first), {region(ProgressBox{4s, 4200ms, 4s, 4200ms})}}});
    bench.step(Wake{}, now += 400ms);
    return {first, second};
  }
};

TEST_F(Horizon, AdmitsAtMostTheHorizonOfEachArmQueue) {
  const std::vector<JobId> jobs = submit_legs(0, 5);
  answer_all_free();
  for (const std::size_t ahead : {0, 1, 2}) {
    EXPECT_EQ(bench.state(jobs[ahead]), JobState::scheduled);
  }
  EXPECT_EQ(bench.state(jobs[3]), JobState::queued);
  ASSERT_EQ(bench.job(jobs[3]).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(jobs[3]).waits_on.front().job, jobs[2]);
  EXPECT_EQ(bench.dispatched.size(), 1u) << "one after the other";
  bench.finished(jobs[0], now += 2s);
  answer_all_free();
  EXPECT_EQ(bench.state(jobs[3]), JobState::scheduled);
  EXPECT_EQ(bench.state(jobs[4]), JobState::queued);
}

TEST_F(Horizon, DoesNotAdmitAMotionThatStartsElsewhere) {
  const JobId out = submit_legs(0, 1).front();
  answer_all_free();
  const JobId elsewhere = bench.submit(move({0}, 0.5, 0, 2s), now += 1ms);
  answer_all_free();
  EXPECT_EQ(bench.state(out), JobState::scheduled);
  EXPECT_EQ(bench.state(elsewhere), JobState::queued);
  bench.finished(out, now += 2s);
  EXPECT_EQ(bench.state(elsewhere), JobState::failed);
}

TEST_F(Horizon, ConflictBeforeItsTurnDoesNotBacklogAJob) {
  const std::vector<JobId> jobs = submit_legs(0, 2);
  bench.answer_free(now += 1ms);
  bench.answer_conflict(now += 1ms, Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.state(jobs[1]), JobState::queued);
  EXPECT_FALSE(bench.job(jobs[1]).times.backlogged_at);
  bench.finished(jobs[0], now += 2s);
  bench.answer_conflict(now += 1ms, Conflict::With::rest, {}, ArmId{1});
  EXPECT_EQ(bench.state(jobs[1]), JobState::backlogged);
}

TEST_F(Horizon, StalledMotionLosesItsPassingOrder) {
  const auto [first, second] = meet();
  EXPECT_EQ(bench.scheduler.find(second)->state(), JobState::scheduled);
  for (Duration progress = 100ms; progress < 3s; progress += 100ms) {
    bench.progressed(second, progress, now += 100ms);
    bench.step(Wake{}, now);
  }
  bench.progressed(second, 3900ms, now += 900ms);
  EXPECT_GT(bench.authority(second), 4s);
  EXPECT_LT(bench.authority(first), 4s);
}

// The first motion is nearer to the region but stalls; the second is slow. The first would pass
// first if it continued now.
TEST_F(Horizon, StalledMotionIsExpectedToKeepStalling) {
  const auto [first, second] = meet();
  for (Duration progress = 100ms; progress <= 1600ms; progress += 100ms) {
    bench.progressed(first, progress + 800ms, now += 50ms);
    bench.progressed(second, progress, now += 50ms);
    bench.step(Wake{}, now);
  }
  for (Duration progress = 1610ms; progress <= 2300ms; progress += 30ms) {
    bench.progressed(second, progress, now += 100ms);
    bench.step(Wake{}, now);
  }
  ASSERT_LT(bench.authority(first), 4s);
  bench.progressed(second, 3800ms, now += 1ms);  // before the orders are reoptimized
  EXPECT_GT(bench.authority(second), 4s);
}

// The first motion is nearer to the region, but at two fifths of its speed it arrives later.
TEST_F(Horizon, SlowMotionIsExpectedToStaySlow) {
  const auto [first, second] = meet();
  for (Duration step = 1ms; step <= 10ms; step += 1ms) {
    bench.progressed(first, 800ms + 40 * step, now += 50ms);
    bench.progressed(second, 100 * step, now += 50ms);
    bench.step(Wake{}, now);
  }
  bench.progressed(second, 3800ms, now += 1ms);
  EXPECT_GT(bench.authority(second), 4s);
  EXPECT_LT(bench.authority(first), 4s);
}

TEST_F(Horizon, StoppedMotionLosesItsPassingOrder) {
  const auto [first, second] = meet();
  bench.step(Stop{{ArmId{0}}, "operator"}, now += 1ms);
  bench.stopped(first, 500ms, now += 100ms);
  for (Duration progress = 100ms; progress < 3900ms; progress += 100ms) {
    bench.progressed(second, progress, now += 100ms);
    bench.step(Wake{}, now);
  }
  EXPECT_GT(bench.authority(second), 4s);
  bench.finished(second, now += 2s);
  bench.step(Resume{{ArmId{0}}}, now += 1ms);
  answer_all_free();
  EXPECT_EQ(bench.dispatched.back().step.job, first);
}

TEST_F(Horizon, PunctualMotionKeepsItsPassingOrder) {
  const auto [first, second] = meet();
  for (Duration progress = 100ms; progress < 3s; progress += 100ms) {
    bench.progressed(first, progress + 800ms, now += 50ms);
    bench.progressed(second, progress, now += 50ms);
    bench.step(Wake{}, now);
  }
  EXPECT_LT(bench.authority(second), 4s);
  bench.progressed(first, 3900ms, now += 50ms);
  EXPECT_GT(bench.authority(first), 4s);
}

// Arm a rests in the way of b's first motion, and moves on only together with b.
TEST_F(Horizon, TeamIsNotAdmittedIfItsArmBlocksItsOtherArm) {
  const JobId held = bench.submit(move({1}, 0, 1, 6s), now += 1ms);
  bench.answer_free(now += 1ms);
  bench.progressed(held, 100ms, now += 1ms);
  const JobId leaves = bench.submit(move({0}, 0, 1, 2s), now += 1ms);
  bench.answer_regions(
      now += 1ms,
      {{only_step(leaves), only_step(held), {region(ProgressBox{0ms, 1200ms, 4s, 4200ms})}}});
  ASSERT_EQ(bench.state(leaves), JobState::scheduled);
  bench.step(Cancel{leaves}, now += 1ms);
  bench.stopped(leaves, 0s, now += 1ms);
  ASSERT_LT(bench.authority(held), 4s);
  const JobId team = bench.submit(move({0, 1}, {0, 1}, {1, 0}, 2s), now += 1ms);
  answer_all_free();
  EXPECT_EQ(bench.state(team), JobState::queued);
  EXPECT_LT(bench.authority(held), 4s);
}

// Returns the time that a motion of 6 s takes if its reports come as late as `promised` permits.
Duration time_of_a_motion(const ControllerDescription& promised, Duration feedback_age) {
  auto cell = std::make_shared<Cell>(*one_joint_arms(1));
  cell->robots[0].controller = promised;
  IdealArms arms(cell, std::move(*make_policy("certified", *cell)), Crossings{},
                 [&](JobId) { return Habits{.feedback_age = feedback_age}; });
  const JobId job = arms.submit({JobId{0}, move({0}, 0, 1, 6s), {}});
  while (arms.state(job) != JobState::succeeded && arms.now() < at(60s)) {
    arms.run_until(arms.now() + 10ms);
  }
  return arms.now() - *arms.job(job).times.scheduled_at;
}

TEST(Promises, ReportsThatAreLateAsPromisedDoNotStopAnArm) {
  ControllerDescription slow;
  slow.reaction = 200ms;
  slow.feedback_period = 50ms;
  slow.feedback_timeout = 1s;
  // The age stands for all delays of the loop: the last report and the effect of the command.
  const Duration late = promises_of(slow).late_response();
  EXPECT_LE(time_of_a_motion(slow, late), 6s + late + 50ms);
  EXPECT_GT(time_of_a_motion(ControllerDescription{}, late), 6s + 2 * late)
      << "authority for the default promises does not reach that far";
}

}  // namespace
}  // namespace armloom

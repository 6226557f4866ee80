#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

constexpr ArmId kFirst{0};

TEST(SpeedOverride, MotionClockRunsAtTheSmallestShareOfAllArms) {
  SpeedOverride speed(2);
  EXPECT_EQ(speed.clock(at(3s)), at(3s));
  speed.set(std::nullopt, 0.5, at(4s));
  speed.set(kFirst, 0.5, at(6s));
  EXPECT_EQ(speed.clock(at(10s)), at(6s));  // 4 s, then 2 s at 0.5, then 4 s at 0.25
  EXPECT_NEAR(to_seconds(speed.when(at(7s))), 14.0, 1e-6);
  EXPECT_GE(speed.clock(speed.when(at(7s))), at(7s));
  speed.set(kFirst, 0.0, at(10s));
  EXPECT_EQ(speed.when(at(7s)), TimePoint::max());
  EXPECT_EQ(speed.clock(at(100s)), at(6s));
}

TEST(SpeedOverride, MotionOfSeveralArmsGoesAtTheSmallestShare) {
  SpeedOverride speed(2);
  speed.set(std::nullopt, 0.5, at(0s));
  speed.set(kFirst, 0.2, at(0s));
  EXPECT_DOUBLE_EQ(speed.effective(ArmId{1}), 0.5);
  EXPECT_DOUBLE_EQ(speed.effective({ArmId{1}, kFirst}), 0.1);
  EXPECT_DOUBLE_EQ(speed.pace({ArmId{1}, kFirst}), 10.0);
  speed.set(std::nullopt, SpeedOverride::kSmallestShare, at(0s));
  EXPECT_DOUBLE_EQ(speed.effective(kFirst), SpeedOverride::kSmallestShare);
}

TEST(SpeedOverride, RefusesSharesOutsideItsRange) {
  Bench bench(1);
  for (const double share : {-0.1, 0.0001, 1.1, std::nan("")}) {
    EXPECT_FALSE(SpeedOverride::is_valid(share));
    EXPECT_THROW((void)bench.scheduler.step(SetSpeed{std::nullopt, share}, at(0s)),
                 std::invalid_argument);
  }
}

struct OneMotion : ::testing::Test {
  OneMotion() {
    job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
    bench.answer_free(at(0ms));
    bench.progressed(job, 500ms, at(500ms));
  }
  void set(double share, TimePoint now) { bench.step(SetSpeed{kFirst, share}, now); }
  const PredictedLeg leg(TimePoint now) const { return bench.scheduler.timeline(now).legs.front(); }

  Bench bench{1};
  JobId job{0};
};

TEST_F(OneMotion, TimelineFollowsTheOverride) {
  set(0.1, at(500ms));
  EXPECT_EQ(leg(at(500ms)).ends, at(15500ms));
  set(0.5, at(500ms));
  EXPECT_EQ(leg(at(500ms)).ends, at(3500ms));
  set(1.0, at(500ms));
  EXPECT_EQ(leg(at(500ms)).ends, at(2s));
}

TEST_F(OneMotion, AtZeroTheJobIsPausedAndNamesTheOverride) {
  set(0.0, at(500ms));
  bench.progressed(job, 520ms, at(520ms));
  EXPECT_FALSE(bench.job(job).pausing()) << "it still moves";
  bench.progressed(job, 520ms, at(600ms));
  EXPECT_TRUE(bench.job(job).pausing());
  ASSERT_EQ(bench.job(job).waits_on.size(), 1U);
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::speed);
  EXPECT_EQ(bench.job(job).waits_on.front().arm, kFirst);
  const PredictedLeg predicted = leg(at(600ms));
  EXPECT_FALSE(predicted.ends);
  EXPECT_EQ(predicted.pauses.back().waits_on->kind, Wait::Kind::speed);
  set(0.5, at(10s));
  EXPECT_TRUE(bench.job(job).waits_on.empty());
  bench.progressed(job, 530ms, at(10100ms));
  EXPECT_FALSE(bench.job(job).pausing());
}

TEST_F(OneMotion, NeverOverrunsBecauseOfTheOverride) {
  set(0.0, at(500ms));
  bench.step(Wake{}, at(1h));
  EXPECT_EQ(bench.state(job), JobState::running);
  set(0.001, at(1h));
  bench.step(Wake{}, at(1h + 30s));  // not measured to move for longer than kStandstill
  EXPECT_EQ(bench.state(job), JobState::running);
  EXPECT_TRUE(bench.braked.empty());
  set(1.0, at(1h + 30s));
  bench.step(Wake{}, at(1h + 60s));
  EXPECT_EQ(bench.braked, std::vector{job}) << "now it does not move although it may";
}

TEST(SpeedOverrideOfJobs, JobDoesNotStartAtZero) {
  Bench bench(2);
  bench.step(SetSpeed{std::nullopt, 0.0}, at(0s));
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0s));
  EXPECT_FALSE(bench.question);
  ASSERT_EQ(bench.job(job).waits_on.size(), 1U);
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::speed);
  EXPECT_FALSE(bench.job(job).waits_on.front().arm) << "it is the cell's";
  bench.step(SetSpeed{std::nullopt, 0.2}, at(5s));
  bench.answer_free(at(5s));
  EXPECT_EQ(bench.dispatched.size(), 1U);
}

TEST(SpeedOverrideOfJobs, AnswerUnderWayStartsNothingAtZero) {
  Bench bench(1);
  (void)bench.submit(move({0}, 0, 1, 2s), at(0s));
  const Version asked = bench.question->version;
  bench.step(SetSpeed{kFirst, 0.0}, at(0s));
  bench.step(Judged{Verdict{Verdict::Kind::free, asked, {}, {}, 1}}, at(1s));
  EXPECT_TRUE(bench.dispatched.empty());
}

TEST(SpeedOverrideOfJobs, BacklogTimeoutCountsByTheMotionClock) {
  Bench bench(2);
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0s));
  bench.answer_free(at(0s));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0s), 10s);
  bench.answer_conflict(at(0s), Conflict::With::motion, first);
  ASSERT_EQ(bench.state(second), JobState::backlogged);
  bench.step(SetSpeed{kFirst, 0.1}, at(4s));
  EXPECT_NEAR(to_seconds(*bench.scheduler.expiry(second)), 64.0, 1e-6);
  bench.step(Wake{}, at(63s));
  EXPECT_EQ(bench.state(second), JobState::backlogged);
  bench.step(Wake{}, at(65s));
  EXPECT_EQ(bench.state(second), JobState::expired);
}

// The second motion enters the region after 1 s (less kShortOf), the first one leaves it after
// 1.5 s.
TEST(SpeedOverrideOfJobs, StartByTheClockFollowsTheOverrides) {
  const auto scheduled_s = [](double first_share, double second_share) {
    Bench bench(2, "earliest_start");
    const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0s));
    bench.answer_free(at(0s));
    bench.step(SetSpeed{ArmId{0}, first_share}, at(0s));
    bench.step(SetSpeed{ArmId{1}, second_share}, at(0s));
    const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0s));
    bench.answer_regions(
        at(0s),
        {{only_step(second), only_step(first), {region(ProgressBox{1s, 1900ms, 0s, 1500ms})}}});
    return to_seconds(*bench.job(second).times.scheduled_at);
  };
  EXPECT_NEAR(scheduled_s(1.0, 1.0), 0.52, 1e-6);
  EXPECT_NEAR(scheduled_s(0.5, 1.0), 2.02, 1e-6);
  EXPECT_NEAR(scheduled_s(0.5, 0.5), 1.04, 1e-6);
  EXPECT_NEAR(scheduled_s(1.0, 0.5), 0.0, 1e-6) << "when it comes there, the first one has left";
}

TEST(SpeedOverrideOfJobs, ScheduledStartIsPredictedAgain) {
  Bench bench(2, "earliest_start");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0s));
  bench.answer_free(at(0s));
  const JobId second = bench.submit(move({1}, 0, 1, 2s), at(0s));
  bench.answer_regions(
      at(0s),
      {{only_step(second), only_step(first), {region(ProgressBox{100ms, 1900ms, 0s, 1500ms})}}});
  EXPECT_EQ(bench.job(second).times.scheduled_at, at(1420ms));
  bench.step(SetSpeed{std::nullopt, 0.1}, at(0s));
  EXPECT_EQ(bench.job(second).times.scheduled_at, at(14200ms));
}

TEST(SpeedOverrideOfJobs, TimedDiscreteComparesAgainAtTheNewSpeeds) {
  Bench bench(2, "timed_discrete");
  const JobId first = bench.submit(move({0}, 0, 1, 2s), at(0s));
  bench.answer_free(at(0s));
  bench.progressed(first, 100ms, at(100ms));
  ASSERT_FALSE(bench.question);
  bench.step(SetSpeed{kFirst, 0.25}, at(200ms));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, first);
  EXPECT_DOUBLE_EQ(bench.question->candidates.front().share, 0.25);
}

}  // namespace
}  // namespace armloom

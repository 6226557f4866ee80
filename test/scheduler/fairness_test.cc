#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"
#include "test/scheduler/ideal_arms.h"

namespace armloom {
namespace {

using ::testing::IsEmpty;

constexpr Duration kAging = 30s;  // the cell's

// Job "old" of arm b has waited for arm a since 2 ms. Arm a's job runs for 40 s.
struct Waits : Bench {
  Waits() : Bench(4, "certified") {
    runs = submit(move({0}, 0, 1, 40s), at(0ms));
    answer_free(at(1ms));
    progressed(runs, 0ms, at(3ms));
    old = submit(move({1}, 0, 1, 2s), at(4ms), 300s);
    answer_conflict(at(5ms), Conflict::With::motion, runs, ArmId{0});
  }
  void on_plan(TimePoint now) { progressed(runs, now - at(3ms), now); }
  JobId candidate() const { return question->candidates.front().step.job; }

  JobId runs{0}, old{0};
};

TEST(Aging, AgedJobDefersLaterJobsOfOtherArms) {
  Waits bench;
  const JobId before = bench.submit(move({2}, 0, 1, 2s), at(5ms) + kAging - 1ns, 60s, 9);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), before);
  bench.answer_conflict(at(5ms) + kAging, Conflict::With::motion, bench.runs, ArmId{0});
  const JobId after = bench.submit(move({3}, 0, 1, 2s), at(5ms) + kAging, 60s, 9);
  EXPECT_FALSE(bench.question) << "not even with a larger priority";
  EXPECT_EQ(bench.state(after), JobState::queued);
  ASSERT_EQ(bench.job(after).waits_on.size(), 1u);
  EXPECT_EQ(bench.job(after).waits_on.front().kind, Wait::Kind::predecessor);
  EXPECT_EQ(bench.job(after).waits_on.front().job, bench.old);
}

TEST(Aging, AgedJobGoesNextThenTheOthers) {
  Waits bench;
  const JobId later = bench.submit(move({2}, 0, 1, 2s), at(35s), 60s, 9);
  bench.finished(bench.runs, at(40s));
  ASSERT_EQ(bench.candidate(), bench.old);
  bench.answer_free(at(40001ms));
  EXPECT_EQ(bench.state(bench.old), JobState::scheduled);
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), later);
  bench.answer_free(at(40002ms));
  EXPECT_THAT(bench.job(later).waits_on, IsEmpty());
}

TEST(Aging, JobsThatMakeWayForAnAgedJobAreNotDeferred) {
  Waits bench;
  const JobId other = bench.submit(move({2}, 0, 1, 2s), at(35s), 60s, 9);
  const JobId in_the_way = bench.submit(move({0}, 1, 0, 2s), at(35s));  // behind the running job
  bench.finished(bench.runs, at(40s));
  ASSERT_EQ(bench.candidate(), bench.old);
  bench.answer_conflict(at(40001ms), Conflict::With::rest, {}, ArmId{0});
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), in_the_way) << "though the other has the larger priority";
  EXPECT_EQ(bench.job(other).waits_on.front().job, bench.old);
  bench.answer_free(at(40002ms));
  ASSERT_EQ(bench.candidate(), bench.old);
  bench.answer_conflict(at(40003ms), Conflict::With::motion, in_the_way, ArmId{0});
  EXPECT_FALSE(bench.question);
  bench.finished(in_the_way, at(42s));
  ASSERT_EQ(bench.candidate(), bench.old);
}

TEST(Aging, AgedJobThatNoOtherJobBlocksDefersNoJob) {
  for (const auto with : {Conflict::With::rest, Conflict::With::scene}) {
    Bench bench(4, "certified");
    const JobId old = bench.submit(move({1}, 0, 1, 2s), at(0ms), 300s);
    bench.answer_conflict(at(1ms), with, {}, ArmId{0});  // an arm without a job, or an object
    const JobId later = bench.submit(move({2}, 0, 1, 2s), at(40s));
    ASSERT_TRUE(bench.question);
    EXPECT_EQ(bench.question->candidates.front().step.job, later);
    bench.answer_free(at(40001ms));
    ASSERT_EQ(bench.question->candidates.front().step.job, old) << "checked again alongside it";
  }
}

TEST(Aging, JobOfAStoppedArmDefersNoJob) {
  Waits bench;
  bench.step(Stop{{ArmId{1}}, "operator"}, at(32s));
  const JobId later = bench.submit(move({2}, 0, 1, 2s), at(35s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), later);
}

TEST(Aging, EarlierJobWithALargerPriorityStillGoesFirst) {
  Bench bench(4, "certified");
  const JobId runs = bench.submit(move({0}, 0, 1, 40s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId behind = bench.submit(move({0}, 1, 0, 2s), at(2ms), 300s, 5);
  const JobId same = bench.submit(move({2}, 0, 1, 2s), at(2ms), 300s, 0);
  bench.answer_conflict(at(3ms), Conflict::With::motion, runs, ArmId{0});
  const JobId old = bench.submit(move({1}, 0, 1, 2s), at(3ms), 300s, 0);
  bench.answer_conflict(at(4ms), Conflict::With::motion, runs, ArmId{0});
  bench.finished(runs, at(40s));
  ASSERT_EQ(bench.question->candidates.front().step.job, behind) << "earlier, and more urgent";
  bench.answer_conflict(at(40001ms), Conflict::With::rest, {}, ArmId{3});
  ASSERT_EQ(bench.question->candidates.front().step.job, same) << "aged the longest";
  bench.answer_conflict(at(40002ms), Conflict::With::motion, runs, ArmId{0});
  EXPECT_FALSE(bench.question) << "the younger of the aged jobs waits";
  EXPECT_EQ(bench.job(old).waits_on.front().job, same);
}

TEST(Aging, PausedJobIsNeverDeferred) {
  Waits bench;
  const JobId held = bench.submit(move({2}, 0, 1, 20s), at(20s));
  bench.answer_free(at(20001ms));
  bench.answer_conflict(at(20002ms), Conflict::With::motion, bench.runs, ArmId{0});
  bench.progressed(held, 0ms, at(20004ms));
  bench.on_plan(at(31s));
  bench.step(Stop{{ArmId{2}}, "operator"}, at(31s));
  ASSERT_EQ(bench.candidate(), bench.old);
  bench.answer_conflict(at(31001ms), Conflict::With::motion, bench.runs, ArmId{0});
  bench.on_plan(at(31100ms));
  bench.stopped(held, 10s, at(31100ms));
  ASSERT_EQ(bench.candidate(), bench.old);
  bench.answer_conflict(at(31102ms), Conflict::With::motion, bench.runs, ArmId{0});
  bench.on_plan(at(32s));
  ASSERT_EQ(bench.state(held), JobState::paused);
  bench.step(Resume{{ArmId{2}}}, at(32s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), held);
}

TEST(Aging, LockstepAgesByRounds) {
  Bench bench(3, "lockstep");
  const JobId runs = bench.submit(move({0}, 0, 1, 40s), at(0ms));
  bench.answer_free(at(1ms));
  const JobId old = bench.submit(move({1}, 0, 1, 2s), at(1ms), 300s);
  bench.answer_conflict(at(2ms), Conflict::With::motion, runs, ArmId{0});
  bench.progressed(runs, 0ms, at(3ms));
  const JobId later = bench.submit(move({2}, 0, 1, 2s), at(35s), 60s, 9);
  EXPECT_EQ(bench.job(later).waits_on.front().kind, Wait::Kind::capacity);
  bench.finished(runs, at(40s));
  EXPECT_EQ(bench.question->candidates.front().step.job, old);
}

TEST(Aging, StartsWhenCapacityIsFirstMissing) {
  Bench bench(2, "sequential");
  const JobId runs = bench.submit(move({0}, 0, 1, 40s), at(0ms), 60s, 9);
  bench.answer_free(at(1ms));
  const JobId old = bench.submit(move({1}, 0, 1, 2s), at(2ms), 60s, 0);
  const JobId next = bench.submit(move({0}, 1, 0, 40s), at(3ms), 60s, 9);
  bench.finished(runs, at(40s));
  EXPECT_EQ(bench.question->candidates.front().step.job, old);
  EXPECT_EQ(bench.state(next), JobState::queued);
}

TEST(Aging, UnderSequentialTheAgedJobGoesNext) {
  Bench bench(2, "sequential");
  const JobId first = bench.submit(move({0}, 0, 1, 40s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::scene);
  const JobId runs = bench.submit(move({1}, 0, 1, 40s), at(2ms), 60s, 9);
  bench.answer_free(at(3ms));
  const JobId next = bench.submit(move({1}, 1, 0, 40s), at(4ms), 60s, 9);
  bench.finished(runs, at(40s));
  ASSERT_EQ(bench.question->candidates.front().step.job, first);
  bench.answer_free(at(40001ms));
  EXPECT_EQ(bench.job(next).waits_on.front().kind, Wait::Kind::capacity);
}

TEST(Priority, IsInheritedByTheJobOfTheBlockingArm) {
  Bench bench(3, "certified");
  const JobId urgent = bench.submit(move({0}, 0, 1, 2s), at(0ms), 60s, 9);
  const JobId middle = bench.submit(move({1}, 0, 1, 2s), at(0ms), 60s, 5);
  const JobId low = bench.submit(move({2}, 0, 1, 2s), at(0ms), 60s, 0);
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{2});
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.question->candidates.front().step.job, low)
      << "inherits the urgent job's priority";
  bench.answer_free(at(2ms));
  ASSERT_EQ(bench.question->candidates.front().step.job, urgent);
  bench.answer_conflict(at(3ms), Conflict::With::motion, low, ArmId{2});
  EXPECT_EQ(bench.question->candidates.front().step.job, middle);
}

TEST(Priority, IsInheritedThroughArmQueuesAndPredecessors) {
  Bench bench(3, "certified");
  const JobId opens = bench.submit(move({2}, 0, 1, 2s), at(0ms), 60s, 0);
  const JobId middle = bench.submit(move({1}, 0, 1, 2s), at(0ms), 60s, 5);
  const JobId low = bench.submit(move({0}, 0, 1, 2s), at(0ms), 60s, 0);
  bench.submit(move({0}, 1, 0, 2s), at(0ms), 60s, 9);  // the urgent job
  ASSERT_EQ(bench.question->candidates.front().step.job, opens);
  bench.answer_free(at(1ms));
  EXPECT_EQ(bench.question->candidates.front().step.job, low)
      << "ahead of the urgent job in its arm queue";
  bench.answer_free(at(2ms));
  EXPECT_EQ(bench.question->candidates.front().step.job, middle);

  Bench after(3, "certified");
  const JobId first = after.submit(move({2}, 0, 1, 2s), at(0ms));
  const JobId before = after.submit(move({1}, 0, 1, 2s), at(0ms), 60s, 0);
  const JobId fair = after.submit(move({0}, 0, 1, 2s), at(0ms), 60s, 5);
  after.step(
      Submit{
          .job = JobId{9}, .trajectory = move({2}, 1, 0, 2s), .terms = {9, 60s}, .after = {before}},
      at(0ms));
  ASSERT_EQ(after.question->candidates.front().step.job, first);
  after.answer_free(at(1ms));
  EXPECT_EQ(after.question->candidates.front().step.job, before);
  after.answer_free(at(2ms));
  EXPECT_EQ(after.question->candidates.front().step.job, fair);
}

// Arm b would end in the path of every job of arm a, so it has to wait for the last of them.
TEST(Starvation, IsFlaggedOnceLaterJobsGoFirstAfterTheBoundAndSaysWhy) {
  const CellPtr cell = one_joint_arms(2);
  ASSERT_EQ(cell->scheduling.aging, kAging);
  IdealArms arms(cell, std::move(*make_policy("coordinated", *cell)),
                 Crossings({{ArmId{0}, 0.4, 0.6, ArmId{1}, 0.4, 0.6}}),
                 [](JobId) { return Habits{}; });
  const auto submit = [&](std::uint32_t arm, double from, double to) {
    return arms.submit({JobId{0}, move({arm}, from, to, 10s), 0, 600s});
  };
  submit(0, 0, 1);
  const JobId parks = submit(1, 0, 0.5);
  JobId last{0};
  for (int i = 0; i < 16; ++i) last = i % 2 == 0 ? submit(0, 1, 0) : submit(0, 0, 1);
  arms.run_until(at(25s));
  ASSERT_EQ(arms.job(parks).waits_on.size(), 1U);
  const Wait& wait = arms.job(parks).waits_on.front();
  EXPECT_EQ(wait.kind, Wait::Kind::predecessor);
  EXPECT_EQ(wait.arm, ArmId{0});
  ASSERT_TRUE(wait.proximity);
  EXPECT_EQ(wait.proximity->arm_a, ArmId{1}) << "its own link comes first";
  EXPECT_EQ(wait.own_time, 10s) << "at its end";
  EXPECT_FALSE(arms.job(parks).starvation);
  arms.run_until(at(75s));
  ASSERT_TRUE(arms.job(parks).starvation);
  EXPECT_LE(arms.job(parks).starvation->waits_since, at(1s));
  const std::size_t so_far = arms.job(parks).starvation->overtaken_by;
  EXPECT_GE(so_far, 1U);
  EXPECT_LE(so_far, 16U);
  arms.run();
  EXPECT_EQ(arms.state(last), JobState::succeeded);
  EXPECT_EQ(arms.state(parks), JobState::succeeded);
  EXPECT_FALSE(arms.job(parks).starvation);
}

}  // namespace
}  // namespace armloom

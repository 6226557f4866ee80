#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

struct TwoWait : Bench {
  TwoWait() : Bench(3, "certified") {
    runs = submit(move({0}, 0, 1, 40s), at(0ms));
    answer_free(at(1ms));
    progressed(runs, 0ms, at(2ms));
    earlier = wait_in_backlog(1, at(10ms));
    later = wait_in_backlog(2, at(20ms));
  }
  JobId wait_in_backlog(std::uint32_t arm, TimePoint now) {
    const JobId job = submit(move({arm}, 0, 1, 2s), now, 10s);
    answer_conflict(now + 1ms, Conflict::With::motion, runs, ArmId{0});
    return job;
  }
  JobId candidate() const { return question->candidates.front().step.job; }

  JobId runs{0}, earlier{0}, later{0};
};

TEST(Amending, RaisedPriorityOvertakesAnOpenQuestion) {
  TwoWait bench;
  bench.finished(bench.runs, at(1s));
  ASSERT_EQ(bench.candidate(), bench.earlier);
  bench.step(Amend{bench.later, {.priority = 5}}, at(1001ms));
  EXPECT_EQ(bench.job(bench.later).job->terms.priority, 5);
  bench.answer_free(at(1002ms));
  EXPECT_EQ(bench.state(bench.earlier), JobState::backlogged) << "the answer is discarded";
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), bench.later);
  bench.answer_free(at(1003ms));
  EXPECT_EQ(bench.state(bench.later), JobState::scheduled);
  EXPECT_EQ(bench.candidate(), bench.earlier);
}

TEST(Amending, ChangedPriorityCausesANewCheck) {
  TwoWait bench;
  ASSERT_FALSE(bench.question);
  bench.step(Amend{bench.earlier, {.priority = 0}}, at(1s));
  EXPECT_FALSE(bench.question);
  bench.step(Amend{bench.earlier, {.priority = 1}}, at(1s));
  ASSERT_TRUE(bench.question);
  EXPECT_EQ(bench.candidate(), bench.earlier);
}

TEST(Amending, TimeoutRunsFromTheFirstConflict) {
  TwoWait bench;
  EXPECT_EQ(bench.wake_at, at(10011ms));
  bench.step(Amend{bench.earlier, {.backlog_timeout = 60s}}, at(1s));
  EXPECT_EQ(bench.wake_at, at(10021ms)) << "deadline of the other job";
  bench.step(Amend{bench.later, {.backlog_timeout = 30s}}, at(1s));
  EXPECT_EQ(bench.wake_at, at(30021ms));
  bench.step(Amend{bench.earlier, {.backlog_timeout = 1s}}, at(2s));
  EXPECT_EQ(bench.state(bench.earlier), JobState::expired) << "the new timeout has already passed";
  EXPECT_EQ(bench.terminal_events[bench.earlier], 1);
  EXPECT_EQ(bench.state(bench.later), JobState::backlogged);
}

TEST(Amending, KeepsTermsThatAreNotNamed) {
  TwoWait bench;
  bench.step(Amend{bench.earlier, {.priority = 7}}, at(1s));
  EXPECT_EQ(bench.job(bench.earlier).job->terms.backlog_timeout, 10s);
  bench.step(Amend{bench.earlier, {.backlog_timeout = 20s}}, at(1s));
  EXPECT_EQ(bench.job(bench.earlier).job->terms.priority, 7);
  EXPECT_EQ(bench.job(bench.earlier).job->terms.on_timeout, OnTimeout::abort);
  bench.step(Amend{bench.earlier, {.on_timeout = OnTimeout::replan}}, at(1s));
  EXPECT_EQ(bench.job(bench.earlier).job->terms.on_timeout, OnTimeout::replan);
}

TEST(Amending, IgnoresEndedAndUnknownJobs) {
  TwoWait bench;
  bench.step(Cancel{bench.later}, at(1s));
  ASSERT_EQ(bench.state(bench.later), JobState::canceled);
  ASSERT_TRUE(bench.question) << "the remaining job is checked again";
  const Version version = bench.question->version;
  bench.step(Amend{bench.later, {.priority = 5}}, at(1s));
  bench.step(Amend{JobId{77}, {.priority = 5}}, at(1s));
  EXPECT_EQ(bench.job(bench.later).job->terms.priority, 0);
  bench.answer_free(at(2s));
  EXPECT_EQ(bench.state(bench.earlier), JobState::scheduled)
      << "the answer on " << version << " still applies";
}

// Admitted motions pass in order of priority until one has authority in the region.
TEST(Amending, RaisedPriorityReversesAPassingOrder) {
  Bench bench(2, "coordinated");
  const JobId first = bench.submit(move({0}, 0, 1, 10s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(first, 0ms, at(2ms));
  const JobId second = bench.submit(move({1}, 0, 1, 10s), at(3ms));
  const ProgressBox meet{6s, 8s, 6s, 8s};
  bench.answer_regions(at(4ms), {{only_step(second), only_step(first), {region(meet)}}});
  ASSERT_EQ(bench.state(second), JobState::scheduled);
  bench.progressed(second, 0ms, at(5ms));
  const auto limit_of = [&](JobId job) { return bench.authority(job); };
  for (Duration t = 100ms; t < 1500ms; t += 100ms) {
    bench.progressed(first, t, at(5ms) + t);
    bench.progressed(second, t, at(6ms) + t);
  }
  bench.step(Amend{second, {.priority = 9}}, at(1500ms));
  for (Duration t = 1600ms; t < 5900ms; t += 100ms) {
    bench.progressed(first, t, at(5ms) + t);
    bench.progressed(second, t, at(6ms) + t);
  }
  EXPECT_LE(limit_of(first), 6s);
  EXPECT_GT(limit_of(second), 6s) << "the more urgent job passes first";
}

}  // namespace
}  // namespace armloom

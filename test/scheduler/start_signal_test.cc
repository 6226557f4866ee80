#include <gmock/gmock.h>

#include <algorithm>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

// Two arms; the job of the first one starts when the signal is true.
struct Waiting : Bench {
  Waiting() : Bench(2) {
    step(SignalChanged{"ready", false, ""}, at(0ms));
    first =
        submit({.job = JobId{0},
                .trajectory = move({0}, 0, 1, 2s),
                .terms = {.backlog_timeout = 10s, .start_when = SignalCondition{"ready", true}}},
               at(1ms));
  }
  [[nodiscard]] bool is_dispatched(JobId job) const {
    return std::ranges::any_of(dispatched, [&](const Dispatch& d) { return d.step.job == job; });
  }
  JobId first{0};
};

TEST(StartSignal, HoldsAJobUntilItHasItsValue) {
  Waiting bench;
  EXPECT_FALSE(bench.question) << "it is not checked while it may not start";
  ASSERT_EQ(bench.job(bench.first).waits_on.size(), 1U);
  const Wait& wait = bench.job(bench.first).waits_on.front();
  EXPECT_EQ(wait.kind, Wait::Kind::io);
  EXPECT_EQ(wait.signal, "ready");
  EXPECT_EQ(wait.detail, "ready is false; the job starts when it is true");
  bench.step(SignalChanged{"ready", std::nullopt, "no connection"}, at(2ms));
  EXPECT_EQ(bench.job(bench.first).waits_on.front().detail,
            "ready is not known: no connection; the job starts when it is true");
  bench.step(SignalChanged{"ready", true, ""}, at(3ms));
  bench.answer_free(at(4ms));
  EXPECT_TRUE(bench.is_dispatched(bench.first));
}

TEST(StartSignal, KeepsThePlaceInTheQueueOfTheArmAndHoldsNoOtherArm) {
  Waiting bench;
  const JobId behind = bench.submit(move({0}, 1, 0, 2s), at(2ms));
  const JobId other = bench.submit(move({1}, 0, 1, 2s), at(3ms));
  bench.answer_free(at(4ms));
  EXPECT_TRUE(bench.is_dispatched(other));
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.state(behind), JobState::queued);
}

TEST(StartSignal, MayChangeBackUntilTheArmMoves) {
  Waiting bench;
  bench.step(SignalChanged{"ready", true, ""}, at(2ms));
  ASSERT_TRUE(bench.question);
  bench.step(SignalChanged{"ready", false, ""}, at(3ms));
  bench.answer_free(at(4ms));
  EXPECT_FALSE(bench.is_dispatched(bench.first)) << "the answer is void";
  bench.step(SignalChanged{"ready", true, ""}, at(5ms));
  bench.answer_free(at(6ms));
  bench.progressed(bench.first, 100ms, at(106ms));
  bench.step(SignalChanged{"ready", false, ""}, at(107ms));
  EXPECT_TRUE(bench.braked.empty()) << "it has started";
  EXPECT_EQ(bench.state(bench.first), JobState::running);
}

// A queued job has no time limit, whatever it waits for.
TEST(StartSignal, HasNoTimeLimitWhileTheJobIsQueued) {
  Waiting bench;
  bench.step(Wake{}, at(1h));
  EXPECT_EQ(bench.state(bench.first), JobState::queued);
  bench.step(SignalChanged{"ready", true, ""}, at(1h + 1s));
  bench.answer_free(at(1h + 2s));
  EXPECT_TRUE(bench.is_dispatched(bench.first));
}

TEST(StartSignal, DoesNotEndTheTimeLimitOfTheBacklog) {
  Waiting bench;
  bench.step(SignalChanged{"ready", true, ""}, at(2ms));
  bench.answer_conflict(at(3ms), Conflict::With::scene);
  EXPECT_EQ(bench.state(bench.first), JobState::backlogged);
  bench.step(SignalChanged{"ready", false, ""}, at(4s));
  bench.step(Wake{}, at(9s));
  EXPECT_EQ(bench.state(bench.first), JobState::backlogged);
  EXPECT_EQ(bench.job(bench.first).waits_on.front().kind, Wait::Kind::io);
  bench.step(Wake{}, at(10s + 3ms));
  EXPECT_EQ(bench.state(bench.first), JobState::expired);
}

}  // namespace
}  // namespace armloom

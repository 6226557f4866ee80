#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

// Arm 1 must retreat for job a, and arm 2 must retreat for arm 1's retreat.
struct Chain : Bench {
  Chain() : Bench(one_joint_arms_that_park(3), "certified") {
    a = submit(move({0}, 0, 1, 2s), at(0ms));
    answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
    answer_free(at(2ms));  // the retreat
    answer_free(at(3ms));  // a's check with arm 1 gone
    way = asides.at(0).job;
    answer_conflict(at(4ms), Conflict::With::rest, {}, ArmId{2});
  }
  bool asks_for_arm_2() const {
    return question && question->candidates.front().step.job == JobId{0} &&
           question->candidates.front().trajectory->arms() == std::vector{ArmId{2}};
  }
  JobId a{0}, way{0};
};

TEST(Retreat, SearchForAHelperEndsWithTheHelpedJob) {
  Chain bench;
  ASSERT_TRUE(bench.asks_for_arm_2());
  bench.step(Cancel{bench.a}, at(5ms));
  bench.answer_free(at(6ms));  // stale
  ASSERT_EQ(bench.question->candidates.front().step.job, bench.way);
  bench.answer_conflict(at(7ms), Conflict::With::rest, {}, ArmId{2});
  EXPECT_FALSE(bench.question);
  EXPECT_EQ(bench.state(bench.way), JobState::backlogged);
}

// The client returns arm 1 again and again; each retreat finds that arm 2 was already asked.
TEST(Retreat, AttemptsForHelpersCountForTheHelpedJob) {
  Chain bench;
  int asked = 0;
  double stands = 0.0;
  std::optional<JobId> sent;
  for (Duration now = 10ms; now < 2s; now += 10ms) {
    if (bench.asks_for_arm_2()) {
      ++asked;
      bench.answer_conflict(at(now), Conflict::With::scene);
    } else if (!bench.question) {
      if (!is_terminal(bench.state(bench.asides.back().job))) {
        bench.step(Cancel{bench.asides.back().job}, at(now));
      }
      sent = bench.submit(move({1}, stands, stands + 0.1, 1s), at(now));
    } else if (const JobId about = bench.question->candidates.front().step.job; about == sent) {
      bench.answer_free(at(now));
      bench.progressed(*sent, 0ms, at(now));
      bench.finished(*sent, at(now));
      stands += 0.1;
    } else if (about == JobId{0}) {
      bench.answer_free(at(now));
    } else if (about == bench.a && std::abs(bench.question->rest[1] - stands) > 1e-9) {
      bench.answer_free(at(now));  // arm 1 has retreated
    } else {
      bench.answer_conflict(at(now), Conflict::With::rest, {}, ArmId{about == bench.a ? 1u : 2u});
    }
  }
  EXPECT_EQ(asked, 8);
}

}  // namespace
}  // namespace armloom

// T9: an endless stream of short, urgent jobs on one arm conflicts with a waiting job of another
// arm, under every policy that could starve that job.
#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

// x passes the crossing back and forth, 2 s each way, with the higher priority. Two more jobs of x
// always wait. y wants to pass once.
struct Stream {
  Stream(const std::string& policy, Duration aging) : cell(description(aging), policy) {
    for (int i = 0; i < 3; ++i) next();
    cell.run_until(at(200ms));
    cell.submit(slide("y", -1, 1, 2, "waits"));
  }
  void run_until(TimePoint end) {
    while (cell.simulation->now() < end) {
      cell.simulation->tick();
      if (cell.simulation->executive().snapshot().queue.queued.size() < 2) next();
    }
  }

  Crossing cell;
  int count = 0;

 private:
  static CellDescription description(Duration aging) {
    CellDescription cell = crossing_description();
    cell.scheduling.aging = aging;
    cell.scheduling.backlog_timeout = 600s;
    return cell;
  }
  void next() {
    const double from = count % 2 == 0 ? -1 : 1;
    JobRequest job = slide("x", from, -from, 2);
    job.terms.priority = 10;
    cell.submit(std::move(job));
    ++count;
  }
};

class EndlessStream : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, EndlessStream, ::testing::ValuesIn(known_policies()));

// The starvation bound of core/scheduler/README.md: aging plus the longest admitted motion.
TEST_P(EndlessStream, StartsTheWaitingJobWithinTheStarvationBound) {
  constexpr Duration kAging = 5s;
  Stream stream(GetParam(), kAging);
  stream.run_until(at(20s));
  const JobView waits = stream.cell.job("waits");
  ASSERT_TRUE(waits.times.started_at);
  EXPECT_LT(*waits.times.started_at, at(200ms) + kAging + 2s + 100ms);
  EXPECT_EQ(waits.state, JobState::succeeded);
  EXPECT_GT(stream.cell.log.closest_m, 0.0);
  EXPECT_GT(stream.count, 8) << "the stream went on";
}

TEST(EndlessStream, StarvesTheWaitingJobWithoutAging) {
  for (const char* policy : {"certified", "reservation"}) {
    Stream stream(policy, 600s);
    stream.run_until(at(60s));
    EXPECT_FALSE(stream.cell.job("waits").times.started_at) << policy;
  }
}

}  // namespace
}  // namespace armloom

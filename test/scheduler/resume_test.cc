#include <gmock/gmock.h>

#include "test/scheduler/bench_cell.h"

namespace armloom {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Resume, WaitingJobReportsItsOriginalBlockerAgain) {
  Bench bench(2, "certified");
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_conflict(at(1ms), Conflict::With::rest, {}, ArmId{1});
  bench.step(Stop{{ArmId{0}}, "operator"}, at(2ms));
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::stop);
  bench.step(Resume{{ArmId{0}}}, at(3ms));
  ASSERT_TRUE(bench.question) << "it is checked again";
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(job).waits_on.front().kind, Wait::Kind::arm);
}

TEST(Resume, BrakingJobNoLongerWaitsForTheStop) {
  Bench bench(1);
  const JobId job = bench.submit(move({0}, 0, 1, 2s), at(0ms));
  bench.answer_free(at(1ms));
  bench.progressed(job, 1ms, at(2ms));
  bench.step(Stop{{ArmId{0}}, "operator"}, at(3ms));
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  bench.step(Resume{{ArmId{0}}}, at(4ms));
  EXPECT_THAT(bench.job(job).waits_on, IsEmpty());
}

TEST(Resume, OfOneTeamArmLeavesTheJobWaitingForTheOther) {
  Bench bench(2);
  bench.step(Stop{{ArmId{0}, ArmId{1}}, "operator"}, at(0ms));
  const JobId job = bench.submit(move({0, 1}, 0, 1, 2s), at(1ms));
  bench.step(Resume{{ArmId{0}}}, at(2ms));
  ASSERT_THAT(bench.job(job).waits_on, SizeIs(1));
  EXPECT_EQ(bench.job(job).waits_on.front().arm, ArmId{1});
}

}  // namespace
}  // namespace armloom

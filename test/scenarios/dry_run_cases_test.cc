// Jobs that are judged against each other without running them.
#include <gtest/gtest.h>

#include "core/executive/dry_run.h"
#include "test/scenarios/polygon.h"

namespace armloom {
namespace {

TEST(DryRun, UnderCoordinatedJobsThatGoTogetherAreFree) {
  const auto cell = build_cell(polygon(3));
  ASSERT_TRUE(cell);
  const std::vector<TimedJob> jobs{{at(0s), slide("a", -1, 1, 4, "one")},
                                   {at(0s), slide("b", -1, 1, 4, "two")},
                                   {at(0s), slide("c", -1, 1, 4, "three")}};
  const auto together = check_jobs(*cell, "coordinated", jobs);
  ASSERT_TRUE(together);
  for (const CheckedJob& job : *together) {
    EXPECT_EQ(job.verdict.kind, Verdict::Kind::free) << job.key;
  }
  const auto alone = check_jobs(*cell, "coordinated", {jobs.front()});
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->front().verdict.kind, Verdict::Kind::conflict);
}

TEST(DryRun, RefusesACellWhoseArmsAreTooCloseAtHomeAsTheServerDoes) {
  CellDescription description = crossing_description();
  description.robots[1].X_WB = description.robots[0].X_WB;
  const auto cell = build_cell(description);
  ASSERT_TRUE(cell);
  Log log;
  const auto served = Simulation::create(*cell, ExecutiveOptions{}, log);
  const auto checked = check_jobs(*cell, "certified", {{at(0s), slide("x", -1, 1, 4, "one")}});
  ASSERT_FALSE(served);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().front().pointer, served.error().front().pointer);
}

}  // namespace
}  // namespace armloom

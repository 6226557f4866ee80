#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/executive/active_policy.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

Problem refused(Crossing& cell, const std::string& policy) {
  const auto changed = cell.simulation->executive().policy().change(policy);
  EXPECT_FALSE(changed);
  return changed ? Problem{} : changed.error().front();
}

std::string policy_of(const Crossing& cell) { return cell.simulation->executive().policy().name(); }

TEST(PolicyChange, IsRefusedWhileAJobRuns) {
  Crossing cell(crossing_description(), "sequential");
  cell.submit(slide("x", -1.0, -0.5, 2.0, "a"));
  cell.run_until(at(1s));
  const Problem problem = refused(cell, "coordinated");
  EXPECT_EQ(problem.slug, "not-at-rest");
  EXPECT_THAT(problem.detail, HasSubstr("a"));
  EXPECT_EQ(policy_of(cell), "sequential");
  cell.run_to_the_end();
  EXPECT_TRUE(cell.simulation->executive().policy().change("coordinated"));
  EXPECT_EQ(policy_of(cell), "coordinated");
}

TEST(PolicyChange, IsRefusedWhileAJobIsPaused) {
  Crossing cell(crossing_description(), "coordinated");
  cell.submit(slide("x", -1.0, 1.0, 4.0, "a"));
  cell.run_until(at(1s));
  stop_all(cell.simulation->executive(), "operator");
  cell.run_until(at(3s));
  ASSERT_EQ(cell.job("a").state, JobState::paused);
  EXPECT_THAT(refused(cell, "sequential").detail, HasSubstr("a"));
}

TEST(PolicyChange, RefusesAnUnknownPolicy) {
  Crossing cell(crossing_description(), "sequential");
  const Problem problem = refused(cell, "best");
  EXPECT_EQ(problem.slug, "unknown-policy");
  EXPECT_EQ(problem.pointer, "/policy");
}

// Two jobs wait behind a stop; under `certified` both start at once after the resume.
TEST(PolicyChange, AppliesToWaitingJobs) {
  for (const bool changes : {false, true}) {
    Crossing cell(crossing_description(), "sequential");
    stop_all(cell.simulation->executive(), "operator");
    cell.submit(slide("x", -1.0, -0.5, 2.0, "a"));
    cell.submit(slide("y", -1.0, -0.5, 2.0, "b"));
    cell.run_until(at(500ms));
    if (changes) {
      ASSERT_TRUE(cell.simulation->executive().policy().change("certified"));
    }
    resume_all(cell.simulation->executive());
    cell.run_to_the_end();
    const TimePoint ended = *cell.job("a").times.ended_at, begun = *cell.job("b").times.started_at;
    EXPECT_EQ(begun < ended, changes);
    EXPECT_EQ(cell.job("b").state, JobState::succeeded);
  }
}

}  // namespace
}  // namespace armloom

#include <gtest/gtest.h>

#include "core/executive/dry_run.h"
#include "test/scenarios/polygon.h"
#include "test/scenarios/tasks.h"

namespace armloom {
namespace {

TEST(DryRun, ReportsJobsThatCanOnlyStartTogetherAsFree) {
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

TEST(DryRun, RefusesACellWhoseArmsAreTooCloseAtHome) {
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

// Each goal starts where the arm's previous job ends. The paths of the first two goals cross in the
// middle.
TEST(DryRun, PlansGoalsFromTheEndsOfEarlierJobs) {
  const auto cell = build_cell(crossing_description());
  ASSERT_TRUE(cell);
  const auto checked = check_jobs(*cell, "certified",
                                  {{at(0s), move_to("x", 0.5, "x")},
                                   {at(0s), move_to("y", 0.8, "y")},
                                   {at(0s), move_to("x", -0.5, "then")},
                                   {at(0s), slide("x", -0.5, 0.2, 2, "from there")}});
  ASSERT_TRUE(checked) << checked.error().front().detail;
  ASSERT_EQ(checked->size(), 4U);
  EXPECT_EQ(checked->at(0).verdict.kind, Verdict::Kind::free);
  EXPECT_EQ(checked->at(1).verdict.kind, Verdict::Kind::conflict) << "x is on its way";
  EXPECT_EQ(checked->at(2).key, "then");
  EXPECT_FALSE(checked->at(2).verdict.result);
  EXPECT_FALSE(checked->at(3).verdict.result);
}

TEST(DryRun, ReportsTheEndOfAGoalWithoutAPathAndOfItsSuccessor) {
  CellDescription description = crossing_description();
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  X_WO.translation() = Eigen::Vector3d(0.5, 0.0, 0.0);
  description.objects.push_back({"post", Box{{0.1, 0.1, 0.1}}, X_WO});
  const auto cell = build_cell(description);
  ASSERT_TRUE(cell);
  JobRequest behind = move_to("y", 0.2, "behind");
  behind.after = {"into it"};
  const auto checked = check_jobs(*cell, "certified",
                                  {{at(0s), move_to("x", 0.5, "into it")},
                                   {at(0s), behind},
                                   {at(0s), move_to("x", -0.5, "before it")}});
  ASSERT_TRUE(checked) << checked.error().front().detail;
  ASSERT_TRUE(checked->at(0).verdict.result);
  EXPECT_EQ(checked->at(0).verdict.result->reason, Reason::no_plan);
  EXPECT_NE(checked->at(0).verdict.result->detail.find("post"), std::string::npos);
  ASSERT_TRUE(checked->at(1).verdict.result);
  EXPECT_EQ(checked->at(1).verdict.result->reason, Reason::predecessor_failed);
  EXPECT_EQ(checked->at(2).verdict.kind, Verdict::Kind::free);
}

TEST(DryRun, NamesNoJobOfTheFileForARetreat) {
  CellDescription description = crossing_description();
  description.scheduling.on_idle_blocker = OnIdleBlocker::park;
  description.execution.velocity_scaling_factor = 0.1;  // a slow retreat
  const auto cell = build_cell(description);
  ASSERT_TRUE(cell);
  const auto checked = check_jobs(*cell, "earliest_start",
                                  {{at(0s), slide("x", -1, 0, 2, "into the middle")},
                                   {at(9s), slide("y", -1, 1, 2, "passes")}});
  ASSERT_TRUE(checked) << checked.error().front().detail;
  ASSERT_EQ(checked->at(1).verdict.waits_on.size(), 1U);
  const WaitView& wait = checked->at(1).verdict.waits_on[0];
  EXPECT_EQ(wait.kind, Wait::Kind::job);
  EXPECT_EQ(wait.job, "");
  EXPECT_EQ(wait.detail, "a motion that the server would add and run first");
}

// ---- Jobs with steps ----

CellDescription with_part(double x) {
  CellDescription cell = with_io();
  cell.objects.push_back({"part", Sphere{kPart_m}, part_at(x).X_WO});
  return cell;
}

std::vector<CheckedJob> dry_run(const CellDescription& description,
                                const std::vector<TimedJob>& jobs) {
  const auto cell = build_cell(description);
  if (!cell) throw std::runtime_error(cell.error().front().detail);
  auto checked = check_jobs(*cell, "certified", jobs);
  if (!checked) throw std::runtime_error(checked.error().front().detail);
  return *std::move(checked);
}

TEST(DryRunOfTasks, KeepsWhatAnArmHoldsForLaterJobs) {
  for (const bool holds : {true, false}) {
    std::vector<StepRequest> steps{slide_to("x", -0.6), slide_to("x", -0.28)};
    if (holds) steps.insert(steps.begin() + 1, attach("x_ball"));
    const auto checked =
        dry_run(holds ? with_part(-0.47) : with_io(),
                {{at(0s), task("pick", steps)}, {at(20s), slide("y", -1, 1, 2, "crosses")}});
    ASSERT_EQ(checked.size(), 2U);
    EXPECT_EQ(checked[0].verdict.kind, Verdict::Kind::free);
    EXPECT_EQ(checked[0].key, "pick");
    const CheckView& crosses = checked[1].verdict;
    EXPECT_EQ(crosses.kind, holds ? Verdict::Kind::conflict : Verdict::Kind::free);
    EXPECT_FALSE(crosses.step) << "it has no steps";
    if (!holds) continue;
    ASSERT_FALSE(crosses.conflicts.empty());
    EXPECT_EQ(crosses.conflicts.front().arm, "x");
  }
}

TEST(DryRunOfTasks, NamesTheFirstStepThatIsNotFree) {
  const auto checked = dry_run(with_part(-0.47), {{at(0s), slide("y", -1, 0, 1, "rests there")},
                                                  {at(5s), task("pick", into_y(true))},
                                                  {at(60s), slide("y", 0, 1, 1, "goes on")}});
  EXPECT_EQ(checked[0].verdict.kind, Verdict::Kind::free);
  const CheckView& pick = checked[1].verdict;
  EXPECT_EQ(pick.kind, Verdict::Kind::conflict);
  EXPECT_EQ(pick.step, 2U);
  EXPECT_EQ(checked[2].key, "goes on");
}

TEST(DryRunOfTasks, PicksUpWhatAJobBeforePutDown) {
  std::vector<StepRequest> again{slide_to("x", 0.5), attach("x_ball"), slide_to("x", 0.2), detach(),
                                 slide_to("x", -1.0)};
  JobRequest behind = slide("y", -1, -0.8, 1, "behind");
  behind.after = {"again"};
  const auto checked = dry_run(
      with_part(0.13),
      {{at(0s), task("pick", pick_and_place())}, {at(0s), task("again", again)}, {at(0s), behind}});
  ASSERT_EQ(checked.size(), 3U);
  for (const CheckedJob& job : checked) {
    EXPECT_EQ(job.verdict.kind, Verdict::Kind::free) << job.key;
  }
  EXPECT_EQ(checked[0].verdict.earliest_start_s, 0.0);
  EXPECT_GT(checked[1].verdict.earliest_start_s.value_or(0.0), 1.0) << "when pick has ended";
  EXPECT_GT(checked[2].verdict.earliest_start_s.value_or(0.0),
            *checked[1].verdict.earliest_start_s);
}

TEST(DryRunOfTasks, FailsAtTheStepAndWithItTheJobsAfter) {
  JobRequest behind = slide("y", -1, -0.8, 1, "behind");
  behind.after = {"pick"};
  const auto checked =
      dry_run(with_part(0.13),
              {{at(0s), task("pick", {slide_to("x", -0.5), attach("x_ball"), slide_to("x", 0.5)})},
               {at(0s), behind}});
  const CheckView& pick = checked[0].verdict;
  ASSERT_TRUE(pick.result);
  EXPECT_EQ(pick.result->reason, Reason::step_failed);
  EXPECT_EQ(pick.step, 1U);
  EXPECT_EQ(pick.earliest_start_s, 0.0) << "the first motion is free";
  ASSERT_TRUE(checked[1].verdict.result);
  EXPECT_EQ(checked[1].verdict.result->reason, Reason::predecessor_failed);
}

}  // namespace
}  // namespace armloom

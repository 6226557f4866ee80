// Results of /check for jobs that still need a plan, compared with the outcome when submitted.
#include <gmock/gmock.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

JobRequest from_elsewhere(const std::string& arm, double from_m, double to_m, std::string key) {
  JobRequest request = slide(arm, from_m, to_m, 1.0, std::move(key));
  request.terms.move_to_start = MoveToStart::plan;
  return request;
}

class CheckedGoals : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { cell.emplace(crossing_description(), GetParam()); }
  CheckView check(JobRequest request) {
    std::optional<CheckView> said;
    cell->simulation->executive().inquiries().check(
        std::move(request), [&](Result<CheckView> answer) {
          ASSERT_TRUE(answer) << answer.error().front().detail;
          said = *answer;
        });
    const TimePoint limit = cell->simulation->now() + 5s;
    while (!said && cell->simulation->now() < limit) cell->simulation->tick();
    EXPECT_TRUE(said) << "no answer";
    return said.value_or(CheckView{});
  }
  [[nodiscard]] std::string set_post(double x, double y) const {
    CollisionObject post{.name = "post", .shape = Box{{0.1, 0.1, 0.1}}};
    post.X_WO.translation() = Eigen::Vector3d(x, y, 0.0);
    return cell->simulation->executive().scene().add(post) ? "" : "not set";
  }
  std::optional<Crossing> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, CheckedGoals, ::testing::ValuesIn(known_policies()));

TEST_P(CheckedGoals, ReportAFreePathWithoutSubmitting) {
  const CheckView said = check(move_to("x", 0.5, "job"));
  EXPECT_EQ(said.kind, Verdict::Kind::free);
  EXPECT_EQ(said.earliest_start_s, 0.0);
  EXPECT_FALSE(said.result);
  EXPECT_FALSE(cell->simulation->executive().job("job")) << "nothing is submitted";
  EXPECT_NEAR(cell->log.last[0], -1.0, 1e-6);
}

TEST_P(CheckedGoals, ReportAConflictWithAnArmAtTheGoal) {
  cell->submit(slide("y", -1, 0, 2));
  cell->run_until(at(3s));
  const CheckView said = check(move_to("x", 0.0, "job"));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  ASSERT_FALSE(said.conflicts.empty());
  EXPECT_EQ(said.conflicts.front().arm, "y");
}

TEST_P(CheckedGoals, ReportThatNoPathExists) {
  ASSERT_EQ(set_post(0.5, 0.0), "");
  const CheckView said = check(move_to("x", 0.5, "job"));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  ASSERT_TRUE(said.result);
  EXPECT_EQ(said.result->reason, Reason::no_plan);
  EXPECT_THAT(said.result->detail, HasSubstr("post"));
}

TEST_P(CheckedGoals, ReportTheArmThatWouldBeSelected) {
  cell->submit(slide("y", -1.0, -0.6, 1.0));
  cell->run_until(at(2s));
  JobRequest request = move_to("", -0.5, "job");
  request.arms = {"x", "y"};
  const CheckView said = check(request);
  EXPECT_EQ(said.kind, Verdict::Kind::free);
  ASSERT_TRUE(said.choice);
  EXPECT_EQ(said.choice->selected, "y");
}

TEST_P(CheckedGoals, PlanTheMoveToStartAndReportItsDuration) {
  const JobRequest job = from_elsewhere("x", -0.5, 0.5, "job");
  const CheckView said = check(job);
  EXPECT_EQ(said.kind, Verdict::Kind::free) << said.conflicts.size();
  ASSERT_TRUE(said.move_to_start_s);
  EXPECT_GT(*said.move_to_start_s, 0.1);
  const TimePoint submitted = cell->simulation->now();
  cell->submit(job);
  cell->run_to_the_end();
  const JobView done = cell->job("job");
  EXPECT_EQ(done.state, JobState::succeeded) << done.detail();
  EXPECT_NEAR(to_seconds(*done.times.started_at - submitted), *said.move_to_start_s, 0.5);
}

// The move-to-start has no job yet, so the check reports the waits of the move-to-start as waits of
// the job.
TEST_P(CheckedGoals, ReportAStoppedArmBeforeItsMoveToStart) {
  cell->simulation->executive().stop({ArmId{0}}, "operator");
  const CheckView said = check(from_elsewhere("x", -0.5, 0.5, "job"));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  ASSERT_EQ(said.conflicts.size(), 1U);
  EXPECT_EQ(said.conflicts[0].kind, Wait::Kind::stop);
  EXPECT_EQ(said.conflicts[0].arm, "x");
}

TEST_P(CheckedGoals, ReportThatNoPathToTheStartExists) {
  ASSERT_EQ(set_post(-0.5, 0.0), "");
  const CheckView said = check(from_elsewhere("x", -0.5, 0.5, "job"));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict) << "it begins in the post";
  ASSERT_TRUE(said.result);
  EXPECT_EQ(said.result->reason, Reason::start_mismatch);
  EXPECT_THAT(said.result->detail, HasSubstr("no path to its start"));
}

TEST_P(CheckedGoals, AssumeThatPlansOfEarlierJobsSucceed) {
  cell->submit(move_to("x", -0.2, "first"));
  const CheckView said = check(move_to("y", -0.2, "job"));
  EXPECT_NE(said.kind, Verdict::Kind::undecided);
  EXPECT_FALSE(said.result);
}

}  // namespace
}  // namespace armloom

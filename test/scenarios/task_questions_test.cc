// Plans and checks of jobs with steps, compared with what the job does.
#include <gmock/gmock.h>

#include <atomic>
#include <map>
#include <memory>

#include "test/scenarios/tasks.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

std::vector<StepRequest> hand_over() {
  return {slide_to("x", 0.0), attach("x_ball"), slide_to("x", -0.26),
          slide_to("y", 0.0), attach("y_ball"), slide_to("x", -1.0),
          slide_to("y", 0.8), detach(),         slide_to("y", -1.0)};
}

struct Asked : Tasks {
  using Tasks::Tasks;
  CheckView check(const JobRequest& request) {
    return answer<CheckView>([&](auto done) { executive().inquiries().check(request, done); });
  }
  StepsPlan plan(const JobRequest& request) {
    return answer<StepsPlan>([&](auto done) {
      executive().inquiries().plan(StepsInquiry{request},
                                   std::make_shared<std::atomic<bool>>(false), done);
    });
  }
  void put_part_at(double x) {
    EXPECT_TRUE(scene().remove("part"));
    EXPECT_TRUE(scene().add(part_at(x)));
  }

 private:
  template <class T>
  T answer(const auto& ask) {
    std::optional<T> found;
    ask([&](Result<T> result) {
      ASSERT_TRUE(result) << result.error().front().detail;
      found = *std::move(result);
    });
    const TimePoint limit = simulation->now() + 10s;
    while (!found && simulation->now() < limit) simulation->tick();
    EXPECT_TRUE(found) << "no answer";
    return found.value_or(T{});
  }
};

class CheckedTask : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, CheckedTask, ::testing::ValuesIn(known_policies()));

TEST_P(CheckedTask, IsFreeAndChangesNothing) {
  Asked cell(with_io(), GetParam());
  const std::uint64_t version = cell.scene().version();
  const CheckView said = cell.check(task("pick", pick_and_place()));
  EXPECT_EQ(said.kind, Verdict::Kind::free);
  EXPECT_EQ(said.earliest_start_s, 0.0);
  EXPECT_FALSE(said.step);
  EXPECT_FALSE(said.result);
  EXPECT_GT(said.evaluations, 0U);
  EXPECT_EQ(said.scene_version, version);
  EXPECT_EQ(cell.scene().version(), version);
  EXPECT_FALSE(cell.executive().job("pick")) << "nothing is submitted";
  EXPECT_NEAR(cell.x_of_part(), 0.13, 1e-9);
  cell.submit(task("pick", pick_and_place()));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("pick").state, JobState::succeeded);
}

TEST_P(CheckedTask, NamesTheStepThatCollidesOnlyWithTheHeldObject) {
  for (const bool holds : {true, false}) {
    Asked cell(with_io(), GetParam());
    cell.put_part_at(-0.47);
    if (!holds) {
      ASSERT_TRUE(cell.scene().remove("part"));
    }
    cell.submit(slide("y", -1.0, 0.0, 1.0, "first"));
    while (!cell.executive().all_ended()) cell.simulation->tick();
    std::vector<StepRequest> steps = into_y(holds);
    std::get<MotionStepRequest>(steps.back().what) = {.trajectory =
                                                          slide("x", -0.6, -0.25, 1.0).trajectory};
    const CheckView said = cell.check(task("pick", steps));
    EXPECT_EQ(said.earliest_start_s, 0.0) << "that of the first motion";
    if (!holds) {
      EXPECT_EQ(said.kind, Verdict::Kind::free);
      continue;
    }
    EXPECT_NE(said.kind, Verdict::Kind::free);
    EXPECT_EQ(said.step, 2U);
    ASSERT_FALSE(said.conflicts.empty());
    EXPECT_EQ(said.conflicts.front().arm, "y");
    EXPECT_EQ(said.conflicts.front().links, (std::vector<std::string>{"part", "y_ball"}));
  }
}

TEST_P(CheckedTask, HandsOver) {
  Asked cell(with_io(), GetParam());
  EXPECT_EQ(cell.check(task("hand over", hand_over())).kind, Verdict::Kind::free);
}

TEST(CheckedTask, EndsWithAMotionUnderWayInTheWay) {
  Asked cell(with_io(), "certified");
  ASSERT_TRUE(cell.scene().remove("part"));
  cell.submit(slide("y", -1.0, 1.0, 8.0, "crosses"));
  cell.run_until(at(500ms));
  const CheckView said =
      cell.check(task("job", {slide_to("x", -0.5), slide_to("x", 0.0), slide_to("x", -1.0)}));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  EXPECT_EQ(said.step, 1U);
  EXPECT_EQ(said.earliest_start_s, 0.0);
  ASSERT_FALSE(said.conflicts.empty());
  EXPECT_EQ(said.conflicts.front().job, "crosses");
}

TEST(CheckedTask, EndsWithTheFirstMotionAsAJobOfItsOwnWould) {
  Asked cell;
  ASSERT_TRUE(cell.scene().remove("part"));
  cell.submit(slide("y", -1.0, 0.0, 1.0, "first"));
  cell.run_until(at(3s));
  const CheckView alone = cell.check(move_to("x", 0.0, "job"));
  const CheckView said = cell.check(task("job", {slide_to("x", 0.0), slide_to("x", -1.0)}));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  EXPECT_EQ(said.kind, alone.kind);
  EXPECT_EQ(said.step, 0U);
  ASSERT_FALSE(said.conflicts.empty());
  ASSERT_EQ(said.conflicts.size(), alone.conflicts.size());
  EXPECT_EQ(said.conflicts.front().kind, alone.conflicts.front().kind);
  EXPECT_EQ(said.conflicts.front().arm, "y");
}

TEST(CheckedTask, NamesTheArmThatIsStoppedAtALaterStep) {
  Asked cell;
  cell.executive().stop({ArmId{1}}, "operator");
  const CheckView said = cell.check(task("job", {slide_to("x", -0.5), slide_to("y", -0.5)}));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  EXPECT_EQ(said.step, 1U);
  ASSERT_FALSE(said.conflicts.empty());
  EXPECT_EQ(said.conflicts.front().kind, Wait::Kind::stop);
}

TEST(CheckedTask, NamesAnAttachThatIsTooFar) {
  Asked cell;
  const JobRequest job = task("pick", {slide_to("x", -0.5), attach("x_ball"), slide_to("x", 0.5)});
  const CheckView said = cell.check(job);
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  EXPECT_EQ(said.step, 1U);
  ASSERT_TRUE(said.result);
  EXPECT_EQ(said.result->reason, Reason::step_failed);
  EXPECT_EQ(said.result->step, 1U);
  cell.submit(job);
  cell.run_to_the_end();
  EXPECT_THAT(cell.job("pick").detail(), HasSubstr(said.result->detail)) << "as in the real run";
}

TEST(CheckedTask, NamesAGoalThatHasNoPathWithTheHeldObject) {
  Asked cell;
  CollisionObject post{.name = "post", .shape = Box{{0.1, 0.1, 0.1}}};
  post.X_WO.translation() = Eigen::Vector3d(0.7, 0.0, 0.0);
  ASSERT_TRUE(cell.scene().add(post));  // from 0.65 on
  const std::vector<StepRequest> bare{slide_to("x", -0.2), slide_to("x", 0.5)};
  const std::vector<StepRequest> holding{slide_to("x", 0.0), attach("x_ball"), slide_to("x", 0.5)};
  const CheckView said = cell.check(task("pick", holding));
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  EXPECT_EQ(said.step, 2U);
  ASSERT_TRUE(said.result);
  EXPECT_EQ(said.result->reason, Reason::no_plan);
  EXPECT_THAT(said.result->detail, HasSubstr("post"));
  ASSERT_TRUE(cell.scene().remove("part"));
  EXPECT_EQ(cell.check(task("bare", bare)).kind, Verdict::Kind::free);
}

// A job that failed beside the part leaves the contact allowed until its arm has moved.
TEST(CheckedTask, EndsTheContactThatAFailedJobLeft) {
  Asked cell;
  cell.submit(task("fails", {slide_to("x", 0.0),
                             {"", WaitIoRequest{"ready", true, 1s}},
                             attach("x_ball"),
                             slide_to("x", -1.0)}));
  cell.run_to_the_end();
  ASSERT_EQ(cell.job("fails").state, JobState::failed);
  ASSERT_FALSE(cell.scene().scene()->touch().empty());
  const JobRequest back = task("back", {slide_to("x", -0.3), slide_to("x", 0.0)});
  const CheckView said = cell.check(back);
  EXPECT_EQ(said.kind, Verdict::Kind::conflict);
  EXPECT_EQ(said.step, 1U);
  const StepsPlan plan = cell.plan(back);
  ASSERT_EQ(plan.refused.index(), 1U);
  EXPECT_EQ(std::get<RefusedInquiry>(plan.refused).pointer, "/steps/1/move_to/joints");
  ASSERT_TRUE(said.result);
  cell.submit(back);
  cell.run_to_the_end();
  ASSERT_TRUE(cell.job("back").result);
  EXPECT_EQ(cell.job("back").result->step, 1U) << "as in the real run";
  EXPECT_EQ(cell.job("back").reason(), said.result->reason);
}

// ---- Plans ----

TEST(PlannedTask, GoesFromStepToStepAndChangesNothing) {
  Asked cell;
  const std::uint64_t version = cell.scene().version();
  const StepsPlan plan = cell.plan(task("pick", pick_and_place()));
  EXPECT_EQ(plan.refused.index(), 0U);
  ASSERT_EQ(plan.steps.size(), 5U);
  double stands = -1.0;
  const std::map<std::size_t, double> ends{{0, 0.0}, {2, 0.5}, {4, -1.0}};
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const PlannedStep& step = plan.steps[i];
    ASSERT_EQ(step.motion != nullptr, ends.contains(i)) << i;
    if (!step.motion) continue;
    EXPECT_EQ(step.arms, std::vector<std::string>{"x"});
    EXPECT_EQ(step.kind, "move_to");
    EXPECT_NEAR(step.motion->start()[0], stands, 1e-9);
    EXPECT_NEAR(step.motion->goal()[0], ends.at(i), 1e-9);
    stands = ends.at(i);
  }
  EXPECT_EQ(plan.steps[1].kind, "attach");
  EXPECT_EQ(plan.steps[1].detail, "part to x_ball");
  EXPECT_EQ(cell.scene().version(), version);
  EXPECT_NEAR(cell.x_of_part(), 0.13, 1e-9);
  EXPECT_FALSE(cell.executive().job("pick"));
  EXPECT_NEAR(cell.log.last[0], -1.0, 1e-6);
}

TEST(PlannedTask, NamesTheStepThatCollidesOnlyWithTheHeldObject) {
  for (const bool holds : {true, false}) {
    Asked cell;
    cell.put_part_at(-0.47);
    if (!holds) {
      ASSERT_TRUE(cell.scene().remove("part"));
    }
    cell.submit(slide("y", -1.0, 0.0, 1.0, "first"));
    while (!cell.executive().all_ended()) cell.simulation->tick();
    const StepsPlan plan = cell.plan(task("pick", into_y(holds)));
    EXPECT_EQ(plan.steps.size(), 2U);
    ASSERT_EQ(plan.refused.index(), holds ? 1U : 0U);
    if (!holds) continue;
    const auto& refused = std::get<RefusedInquiry>(plan.refused);
    EXPECT_EQ(refused.why.reason, PlanRefusal::Reason::goal_in_collision);
    EXPECT_EQ(refused.pointer, "/steps/2/move_to/joints");
    EXPECT_THAT(refused.why.detail, HasSubstr("part"));
    EXPECT_TRUE(refused.why.nearest);
  }
}

TEST(PlannedTask, NamesAnAttachThatIsTooFar) {
  Asked cell;
  const StepsPlan plan =
      cell.plan(task("pick", {slide_to("x", -0.5), attach("x_ball"), slide_to("x", 0.5)}));
  ASSERT_EQ(plan.refused.index(), 2U);
  const Problem& problem = std::get<Problems>(plan.refused).front();
  EXPECT_EQ(problem.slug, "too-far");
  EXPECT_EQ(problem.pointer, "/steps/1/attach/object");
  EXPECT_THAT(problem.detail, HasSubstr("move the hand to the object"));
  EXPECT_EQ(plan.steps.size(), 1U);
}

TEST(PlannedTask, BeginsWhereAcceptedJobsLeaveTheArm) {
  Asked cell;
  cell.submit(slide("x", -1.0, -0.4, 5.0, "before"));
  const StepsPlan plan = cell.plan(task("job", {slide_to("x", -0.8), slide_to("x", -0.9)}));
  ASSERT_EQ(plan.steps.size(), 2U);
  EXPECT_NEAR(plan.steps[0].motion->start()[0], -0.4, 1e-9);
}

TEST(PlannedTask, HandsOver) {
  Asked cell;
  const StepsPlan plan = cell.plan(task("hand over", hand_over()));
  EXPECT_EQ(plan.refused.index(), 0U);
  EXPECT_EQ(plan.steps.size(), 9U);
}

}  // namespace
}  // namespace armloom

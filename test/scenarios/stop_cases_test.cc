#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

TEST(Stop, PausesAllMotionsAndResumeFinishesThem) {
  Crossing cell;
  cell.submit(slide("x", -1, -0.4, 4, "one"));
  cell.submit(slide("y", -1, -0.4, 4, "two"));
  cell.run_until(at(2s));
  stop_all(cell.simulation->executive(), "operator");
  cell.run_until(at(3s));
  EXPECT_EQ(cell.job("one").state, JobState::paused);
  EXPECT_FALSE(cell.job("one").motion.stopping);
  EXPECT_EQ(cell.job("one").waits_on.front().kind, Wait::Kind::stop);
  const Configuration stands = cell.log.last;
  cell.run_until(at(10s));
  EXPECT_EQ(cell.log.last, stands);
  resume_all(cell.simulation->executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("one").state, JobState::succeeded);
  EXPECT_EQ(cell.job("two").state, JobState::succeeded);
}

// y would rest in the path of the stopped arm x for good. So y waits, as it would if x were not
// stopped.
TEST(Stop, JobsDoNotBlockAWaitingJobOfTheStoppedArm) {
  for (const std::string& policy : known_policies()) {
    Crossing cell(crossing_description(), policy);
    Executive& executive = cell.simulation->executive();
    stop_all(executive, "operator");
    cell.submit(slide("x", -1.0, 1.0, 4.0, "through"));
    cell.submit(slide("y", -1.0, 0.0, 2.0, "into"));
    executive.resume({ArmId{1}});
    cell.run_until(at(5s));
    const JobView waits = cell.job("into");
    EXPECT_EQ(waits.state, JobState::queued) << policy;
    ASSERT_EQ(waits.waits_on.size(), 1U) << policy;
    EXPECT_EQ(waits.waits_on.front().job, "through") << policy;
    resume_all(executive);
    cell.run_to_the_end();
    for (const char* job : {"through", "into"}) {
      EXPECT_EQ(cell.job(job).state, JobState::succeeded) << policy << ", " << job;
    }
  }
}

TEST(WindDown, BringsArmsToRestAndEndsEveryJobOnce) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "moves"));
  cell.submit(slide("y", -1, 1, 4, "waits"));
  cell.run_until(at(1500ms));
  bool done = false;
  cell.simulation->executive().wind_down("the server ends", Executive::Waiting::ends,
                                         [&] { done = true; });
  EXPECT_FALSE(cell.simulation->executive().submit(slide("x", 1, -1, 4)));
  cell.run_until(at(3s));
  EXPECT_TRUE(done);
  EXPECT_EQ(cell.job("moves").state, JobState::interrupted);
  EXPECT_EQ(cell.job("waits").state, JobState::interrupted);
  const Configuration stands = cell.log.last;
  cell.run_until(at(5s));
  EXPECT_EQ(cell.log.last, stands);
}

// Under timed_discrete no passing orders keep an arm away from another arm that stops in its way.
class TimedDiscreteStop : public ::testing::Test {
 protected:
  static constexpr ArmId kX{0};
  // Expects that y keeps clear of x, which is stopped or stalled in the middle.
  void expect_nobody_drives_into_it(const std::string& first) {
    std::optional<CheckView> view;
    cell.simulation->executive().inquiries().check(
        slide("y", -1, 1, 4), [&](const Result<CheckView>& made) { view = *made; });
    cell.run_until(cell.simulation->now() + 100ms);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->kind, Verdict::Kind::conflict);
    cell.submit(slide("y", -1, 1, 4, "other"));
    cell.run_until(cell.simulation->now() + 6s);
    EXPECT_EQ(cell.job("other").state, JobState::backlogged);
    EXPECT_GT(cell.log.closest_m, 0.0);
    resume_all(cell.simulation->executive());
    cell.run_to_the_end();
    for (const std::string& key : {first, std::string("other")}) {
      EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key;
    }
    EXPECT_GT(cell.log.closest_m, 0.0);
  }
  Crossing cell;
};

TEST_F(TimedDiscreteStop, StoppedArmBlocksLaterJobs) {
  cell.submit(slide("x", -1, 1, 4, "stopped"));
  cell.run_until(at(2s));
  cell.simulation->executive().stop({kX}, "operator");
  cell.run_until(at(4s));
  expect_nobody_drives_into_it("stopped");
}

TEST_F(TimedDiscreteStop, StalledArmBlocksLaterJobs) {
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(2s), .lasting = 8s}));
  cell.submit(slide("x", -1, 1, 4, "stalls"));
  cell.run_until(at(3s));
  expect_nobody_drives_into_it("stalls");
}

TEST_F(TimedDiscreteStop, MotionPausesBeforeAnArmThatStops) {
  cell.submit(slide("x", -1, 1, 3, "ahead"));
  cell.submit(slide("y", -1, 1, 6, "behind"));
  cell.run_until(at(1500ms));
  ASSERT_EQ(cell.job("behind").state, JobState::running)
      << "by the clock it passes behind the other";
  cell.simulation->executive().stop({kX}, "operator");
  cell.run_until(at(8s));
  EXPECT_EQ(cell.job("behind").state, JobState::paused);
  EXPECT_GT(cell.log.closest_m, 0.0);
  resume_all(cell.simulation->executive());
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("behind").state, JobState::succeeded);
  EXPECT_GT(cell.log.closest_m, 0.0);
}

TEST_F(TimedDiscreteStop, MotionPausesBeforeAnArmThatStalls) {
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(1500ms), .lasting = 20s}));
  cell.submit(slide("x", -1, 1, 3, "ahead"));
  cell.submit(slide("y", -1, 1, 6, "behind"));
  cell.run_until(at(1500ms));
  ASSERT_EQ(cell.job("behind").state, JobState::running);
  cell.run_until(at(8s));
  EXPECT_EQ(cell.job("behind").state, JobState::paused);
  EXPECT_GT(cell.log.closest_m, 0.0);
}

TEST_F(TimedDiscreteStop, MotionPausesBeforeAnArmThatIsCanceled) {
  cell.submit(slide("x", -1, 1, 3, "ahead"));
  cell.submit(slide("y", -1, 1, 6, "behind"));
  cell.run_until(at(1500ms));
  ASSERT_TRUE(cell.simulation->executive().cancel("ahead"));
  cell.run_until(at(8s));
  EXPECT_EQ(cell.job("behind").state, JobState::paused);
  EXPECT_GT(cell.log.closest_m, 0.0);
}

TEST(StopCategories, Category1SwitchesTheDrivesOffAtRestAndTheJobContinues) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "goes on"));
  cell.run_until(at(1s));
  Executive& executive = cell.simulation->executive();
  stop_all(executive, "operator", StopCategory::brake_then_switch_off);
  cell.run_until(at(1010ms));
  EXPECT_TRUE(executive.arms()[0].drives_on) << "while it brakes";
  EXPECT_FALSE(executive.arms()[1].drives_on) << "it rests";
  cell.run_until(at(3s));
  EXPECT_FALSE(executive.arms()[0].drives_on);
  EXPECT_EQ(cell.job("goes on").state, JobState::paused);
  resume_all(executive);
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("goes on").state, JobState::succeeded);
  EXPECT_TRUE(executive.arms()[0].drives_on);
}

TEST(StopCategories, Category0TakesTheArmOffItsPathAndFailsItsJob) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "leaves its path"));
  cell.run_until(at(1s));
  Executive& executive = cell.simulation->executive();
  executive.stop({ArmId{0}}, "operator", StopCategory::switch_off);
  cell.run_until(at(3s));
  EXPECT_FALSE(executive.arms()[0].drives_on);
  EXPECT_TRUE(executive.arms()[1].drives_on) << "it was not stopped";
  EXPECT_EQ(cell.job("leaves its path").state, JobState::failed);
  EXPECT_EQ(cell.job("leaves its path").reason(), Reason::arm_fault);
  const double stands = executive.arms()[0].q.front();
  resume_all(executive);
  cell.submit(slide("x", stands, 1, 4, "from there"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("from there").state, JobState::succeeded);
}

}  // namespace
}  // namespace armloom

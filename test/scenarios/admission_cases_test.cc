// Defect cases T1, T2, T3 and T11 of DESIGN.md, section 1, on simulated time.
#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

TEST(SimultaneousConflict, RunsOneJobAndBacklogsTheOther) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "first"));
  cell.submit(slide("y", -1, 1, 4, "second"));
  cell.run_until(at(1s));
  EXPECT_EQ(cell.job("first").state, JobState::running);
  const JobView second = cell.job("second");
  EXPECT_EQ(second.state, JobState::backlogged);
  ASSERT_EQ(second.waits_on.size(), 1u);
  EXPECT_EQ(second.waits_on.front().job, "first");
  EXPECT_EQ(second.waits_on.front().arm, "x");
  EXPECT_EQ(second.waits_on.front().links, (std::vector<std::string>{"y_ball", "x_ball"}));

  cell.run_to_the_end();
  EXPECT_EQ(cell.job("first").state, JobState::succeeded);
  EXPECT_EQ(cell.job("second").state, JobState::succeeded);
  EXPECT_GE(*cell.job("second").times.started_at, *cell.job("first").times.ended_at);
  EXPECT_GT(cell.log.closest_m, 0.02);
}

TEST(RemainingMotion, IsTheOnlyPartThatIsChecked) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "first"));
  cell.run_until(at(3s));
  cell.submit(slide("y", -1, 1, 4, "second"));  // a check from zero would find a conflict at 2 s
  cell.run_until(at(3100ms));
  EXPECT_EQ(cell.job("second").state, JobState::running);
  cell.run_to_the_end();
  EXPECT_GT(cell.log.closest_m, 0.02);
}

TEST(RestingArm, BlocksItsEndPoseBeforeAndAfterItsJob) {
  Crossing cell;
  cell.submit(slide("y", -1, 0, 2, "short"));  // comes to rest at the origin
  cell.submit(slide("x", -1, 1, 8, "long"));   // passes there 2 s later
  cell.run_until(at(1s));
  EXPECT_EQ(cell.job("short").state, JobState::running);
  EXPECT_EQ(cell.job("long").state, JobState::backlogged);
  EXPECT_EQ(cell.job("long").waits_on.front().job, "short");
  cell.run_until(at(4s));
  EXPECT_EQ(cell.job("short").state, JobState::succeeded);
  EXPECT_EQ(cell.job("long").state, JobState::backlogged) << "the arm at rest still stands there";
  EXPECT_EQ(cell.job("long").waits_on.front().kind, Wait::Kind::arm);
  EXPECT_EQ(cell.job("long").waits_on.front().arm, "y");
  cell.submit(slide("y", 0, -1, 2, "leaves"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("long").state, JobState::succeeded);
  EXPECT_GT(cell.log.closest_m, 0.02);
}

TEST(StaleStart, IsRefusedWithPlaceAndValue) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "first"));
  const auto refused = cell.simulation->executive().submit(slide("x", -1, 0.5, 4, "again"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, "/trajectory/points/0/positions/0");
  EXPECT_EQ(refused.error().front().detail.find(
                "waypoint 0, x_slide: begins at -1 m, but the joint will be at 1 m after the jobs "
                "accepted for the arm; begin there, or "),
            0U);
  EXPECT_FALSE(cell.simulation->executive().job("again"));
}

// The server rolls back jobs whose acceptance was never reported to the client.
TEST(RolledBackJob, IsForgottenAndItsKeyCanBeReused) {
  Crossing cell;
  Executive& executive = cell.simulation->executive();
  cell.submit(slide("x", -1, 1, 4, "waits"));
  executive.roll_back("waits");
  EXPECT_FALSE(executive.job("waits")) << "it had not begun";
  executive.roll_back("nobody");
  cell.submit(slide("x", -1, 1, 4, "waits"));
  JobRequest after = slide("y", -1, 1, 4, "after");
  after.after = {"waits"};
  cell.submit(after);
  cell.run_until(at(1s));
  executive.roll_back("waits");
  EXPECT_TRUE(executive.job("waits")) << "it brakes";
  cell.run_until(at(2s));
  EXPECT_FALSE(executive.job("waits"));
  EXPECT_EQ(cell.job("after").reason(), Reason::predecessor_failed);
  EXPECT_TRUE(executive.all_ended());
  EXPECT_EQ(executive.snapshot().jobs.size(), 1U);
  std::size_t ends = 0;
  for (const Event& event : cell.log.events) {
    const auto* job = std::get_if<JobView>(&event.body);
    ends += job != nullptr && job->key == "waits" && is_terminal(job->state) ? 1 : 0;
  }
  EXPECT_EQ(ends, 2U) << "who reads events is told of the end of each";
}

}  // namespace
}  // namespace armloom

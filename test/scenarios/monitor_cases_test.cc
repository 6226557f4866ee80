#include <gtest/gtest.h>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

// Returns the crossing with a time step longer than both motions: only their ends are compared, so
// no conflict is found.
CellDescription blind_crossing() {
  CellDescription description = crossing_description();
  description.checking.time_step = 10s;
  return description;
}

std::vector<MonitorEvent> findings(const Log& log) {
  std::vector<MonitorEvent> found;
  for (const Event& event : log.events) {
    if (const auto* monitor = std::get_if<MonitorEvent>(&event.body)) found.push_back(*monitor);
  }
  return found;
}

TEST(Monitor, StopsTheArmsAndReportsLinksAndDistance) {
  CellDescription description = blind_crossing();
  description.monitor.stop_clearance_m = 0.3;  // early enough to stop before contact
  description.clearance_m = 0.3;
  Crossing cell(description);
  cell.submit(slide("x", -1, 1, 4, "one"));
  cell.submit(slide("y", -1, 1, 4, "two"));
  cell.run_until(at(5s));
  const auto found = findings(cell.log);
  ASSERT_GE(found.size(), 1u);
  EXPECT_EQ(found.front().finding.kind, MonitorFinding::Kind::clearance);
  EXPECT_EQ(found.front().finding.proximity.body_a, "x_ball");
  EXPECT_EQ(found.front().finding.proximity.body_b, "y_ball");
  EXPECT_LT(found.front().finding.proximity.clearance_m, 0.3);
  EXPECT_EQ(found.front().stopped, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(cell.job("one").state, JobState::paused);
  EXPECT_EQ(cell.job("two").state, JobState::paused);
  EXPECT_EQ(cell.job("one").waits_on.front().kind, Wait::Kind::stop);
  EXPECT_GT(cell.log.closest_m, 0.0) << "no contact";
}

TEST(Monitor, StoppedArmsCanBeMovedApart) {
  CellDescription description = blind_crossing();
  description.monitor.stop_clearance_m = 0.3;
  description.clearance_m = 0.3;
  description.checking.time_step = 10s;
  Crossing cell(description);
  cell.submit(slide("x", -1, 1, 4, "one"));
  cell.submit(slide("y", -1, 1, 4, "two"));
  cell.run_until(at(5s));
  ASSERT_TRUE(cell.simulation->executive().cancel("one"));
  cell.run_until(at(5100ms));
  EXPECT_EQ(cell.job("one").state, JobState::canceled);
  const double stands = cell.log.last[0];
  ASSERT_TRUE(cell.simulation->executive().cancel("two"));
  resume_all(cell.simulation->executive());
  cell.submit(slide("x", stands, -1, 3, "retreat"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("retreat").state, JobState::succeeded);
}

TEST(Monitor, DoesNotStopUninvolvedArms) {
  CellDescription description = blind_crossing();
  description.clearance_m = 0.3;
  description.monitor.stop_clearance_m = 0.3;
  RobotDescription far = description.robots[0];
  far.name = "far";
  far.prefix = "far_";
  far.arms[0].name = "far";
  far.X_WB.translation().z() = 5.0;
  description.robots.push_back(far);
  Crossing cell(description);
  cell.submit(slide("x", -1, 1, 4, "one"));
  cell.submit(slide("y", -1, 1, 4, "two"));
  cell.submit(slide("far", -1, 1, 4, "three"));
  cell.run_until(at(6s));
  EXPECT_EQ(cell.job("one").state, JobState::paused);
  EXPECT_EQ(cell.job("three").state, JobState::succeeded);
}

}  // namespace
}  // namespace armloom

#include <gmock/gmock.h>
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

using Kind = MonitorFinding::Kind;

void drift(Crossing& cell, const std::string& arm, TimePoint from, double m_s,
           std::optional<Duration> lasting = {}) {
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = arm, .kind = ArmFault::Kind::drift, .at = from, .lasting = lasting, .value = m_s}));
}

TEST(Monitor, StopsAnArmThatLeavesItsPath) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, -0.5, 4, "drifts"));
  cell.submit(slide("y", -1, -0.5, 4, "unconcerned"));
  drift(cell, "x", at(1s), 0.05);
  cell.run_until(at(3s));
  const auto found = findings(cell.log);
  ASSERT_EQ(found.size(), 1u);
  const MonitorFinding& finding = found.front().finding;
  EXPECT_EQ(finding.kind, Kind::deviation);
  EXPECT_EQ(found.front().joint, "x_slide");
  EXPECT_GT(finding.value, 0.001);
  EXPECT_LE(finding.value, 0.003) << "one period later at the latest";
  EXPECT_EQ(finding.limit, 0.001);
  EXPECT_LE(finding.time, at(1100ms)) << "when it has drifted farther than it lags";
  EXPECT_EQ(found.front().stopped, std::vector<std::string>{"x"});
  const JobView stopped = cell.job("drifts");
  EXPECT_EQ(stopped.state, JobState::paused);
  ASSERT_EQ(stopped.waits_on.front().kind, Wait::Kind::stop);
  EXPECT_EQ(stopped.waits_on.front().detail, "monitor: " + found.front().text);
  EXPECT_THAT(found.front().text, testing::StartsWith("arm x is off its path: x_slide by 0.00"));
  EXPECT_LT(cell.log.last[0], -0.8) << "it has stopped";
  EXPECT_EQ(cell.job("unconcerned").state, JobState::running);
  cell.run_until(at(5s));
  EXPECT_EQ(cell.job("unconcerned").state, JobState::succeeded);
}

TEST(Monitor, StopsAnArmAgainThatDriftsAfterAResume) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, -0.5, 4, "drifts"));
  drift(cell, "x", at(1s), 0.05);
  cell.run_until(at(3s));
  ASSERT_EQ(cell.job("drifts").state, JobState::paused);
  resume_all(cell.simulation->executive());
  cell.run_until(at(5s));  // the fault goes on: the arm drifts again
  EXPECT_EQ(findings(cell.log).size(), 2u);
  EXPECT_EQ(cell.job("drifts").state, JobState::paused);
}

TEST(Monitor, StopsAnArmThatMovesWithoutAJob) {
  Crossing cell(crossing_description(), "certified");
  drift(cell, "x", at(1s), 0.05);
  cell.submit(slide("y", -1, -0.5, 4, "unconcerned"));
  cell.run_until(at(3s));
  const auto found = findings(cell.log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().finding.kind, Kind::unplanned_motion);
  EXPECT_EQ(found.front().stopped, std::vector<std::string>{"x"});
  EXPECT_NEAR(cell.log.last[0], -1, 0.003) << "the brake ended the drift";
  cell.submit(slide("x", -1, 0, 2, "waits"));
  cell.run_until(at(5s));
  EXPECT_EQ(cell.job("waits").waits_on.front().kind, Wait::Kind::stop);
  EXPECT_EQ(cell.job("unconcerned").state, JobState::succeeded);
}

TEST(Monitor, StopsANoisyArmAtRestAgainAfterAResume) {
  Crossing cell(crossing_description(), "certified");
  Executive& executive = cell.simulation->executive();
  ASSERT_TRUE(
      executive.faults().inject({.arm = "x", .kind = ArmFault::Kind::noise, .value = 0.01}));
  cell.run_until(at(1s));
  ASSERT_FALSE(findings(cell.log).empty());
  const std::size_t before = findings(cell.log).size();
  resume_all(executive);
  cell.run_until(at(2s));
  const auto found = findings(cell.log);
  ASSERT_GT(found.size(), before);
  EXPECT_EQ(found[before].stopped, std::vector<std::string>{"x"});
  EXPECT_LT(found[before].finding.time, at(1100ms));
}

TEST(Monitor, SwitchesDrivesOffIfAnArmWithoutAJobIgnoresItsBrake) {
  Crossing cell(crossing_description(), "certified");
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::ignore_stop}));
  drift(cell, "x", at(1s), 0.05);
  cell.run_until(at(5s));
  const auto found = findings(cell.log);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].finding.kind, Kind::unplanned_motion);
  EXPECT_EQ(found[1].finding.kind, Kind::stop_ignored);
  const double stands = cell.log.last[0];
  EXPECT_LT(stands, -0.8);
  cell.run_until(at(6s));
  EXPECT_EQ(cell.log.last[0], stands);
}

// Without the guard, only the look-ahead keeps the arms apart.
TEST(Monitor, StopsArmsBeforeTheyAreTooClose) {
  for (const double stop_clearance_m : {0.01, 0.02, 0.3}) {
    CellDescription description = blind_crossing();
    description.monitor.stop_clearance_m = stop_clearance_m;
    description.clearance_m = std::max(0.02, stop_clearance_m);
    Crossing cell(description);
    cell.submit(slide("x", -1, 1, 4, "one"));
    cell.submit(slide("y", -1, 1, 4, "two"));
    cell.run_until(at(10s));
    const auto found = findings(cell.log);
    ASSERT_GE(found.size(), 1u);
    EXPECT_EQ(found.front().finding.kind, Kind::approach);
    EXPECT_EQ(found.front().finding.proximity.body_a, "x_ball");
    EXPECT_EQ(found.front().finding.proximity.body_b, "y_ball");
    EXPECT_EQ(found.front().finding.limit_m, stop_clearance_m);
    for (const MonitorEvent& event : found) EXPECT_EQ(event.finding.kind, Kind::approach);
    EXPECT_EQ(cell.job("one").state, JobState::paused);
    EXPECT_EQ(cell.job("one").waits_on.front().kind, Wait::Kind::stop);
    EXPECT_GE(cell.log.closest_m, stop_clearance_m);
    EXPECT_LT(cell.log.closest_m, stop_clearance_m + 0.15) << "and not much earlier";
  }
}

TEST(Monitor, StopsOneArmIfTheOtherCanPass) {
  CellDescription description = blind_crossing();
  Crossing cell(description);
  cell.submit(slide("x", -1, 1, 4, "one"));
  cell.submit(slide("y", -1, 1, 4.3, "two"));  // a little later: "one" could not pass before it
  cell.run_until(at(10s));
  const bool one_paused = cell.job("one").state == JobState::paused;
  const bool two_paused = cell.job("two").state == JobState::paused;
  EXPECT_TRUE(one_paused || two_paused);
  EXPECT_GE(cell.log.closest_m, 0.01);
}

// x stalls in the way of y, which the time steps did not foresee.
TEST(Monitor, StopsAnArmBeforeAnArmThatStalls) {
  Crossing cell(crossing_description());
  cell.submit(slide("x", -1, 1, 4, "stalls"));
  cell.run_until(at(700ms));
  cell.submit(slide("y", -1, 1, 8, "follows"));
  ASSERT_TRUE(cell.simulation->executive().faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::stall, .at = at(2s), .lasting = 100s}));
  cell.run_until(at(12s));
  EXPECT_GE(cell.log.closest_m, 0.01);
}

// y is certified to pass x at rest. x then moves towards y's path, too far to leave enough room.
TEST(Monitor, StopsAnArmThatAnArmOffItsRestEndangers) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, -0.25, 3, "first"));
  cell.run_to_the_end();
  cell.submit(slide("y", -1, 1, 4, "passes"));
  cell.run_until(at(3500ms));
  ASSERT_EQ(cell.job("passes").state, JobState::running);
  cell.log.may_refuse = true;  // the guard sees x before the scheduler is told of it
  drift(cell, "x", at(3501ms), 4.0, 300ms);
  cell.run_until(at(12s));
  const auto found = findings(cell.log);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].finding.kind, Kind::unplanned_motion);
  EXPECT_EQ(found[0].stopped, std::vector<std::string>{"x"});
  EXPECT_FALSE(is_terminal(cell.job("passes").state));
  EXPECT_FALSE(cell.job("passes").waits_on.empty());
  EXPECT_GE(cell.log.closest_m, 0.01);
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

TEST(Monitor, SwitchesTheDrivesOfAnArmOffThatIgnoresItsStop) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, 1, 8, "ignores"));
  Executive& executive = cell.simulation->executive();
  for (const auto kind : {ArmFault::Kind::ignore_stop, ArmFault::Kind::runaway}) {
    ASSERT_TRUE(
        executive.faults().inject({.arm = "x", .kind = kind, .at = at(1s), .lasting = 100s}));
  }
  cell.run_until(at(2s));
  executive.stop({ArmId{0}}, "operator");
  cell.run_until(at(2100ms));
  EXPECT_TRUE(executive.arms()[0].drives_on) << "it could still be braking";
  cell.run_until(at(4s));
  EXPECT_FALSE(executive.arms()[0].drives_on);
  EXPECT_EQ(cell.job("ignores").reason(), Reason::arm_fault);
  const double stands = executive.arms()[0].q.front();
  cell.run_until(at(5s));
  EXPECT_EQ(executive.arms()[0].q.front(), stands);
}

TEST(Monitor, LeavesTheDrivesOnIfAnArmRestsAtItsAuthority) {
  Crossing cell(crossing_description(), "certified");
  cell.submit(slide("x", -1, 1, 8, "ignores"));
  Executive& executive = cell.simulation->executive();
  ASSERT_TRUE(executive.faults().inject(
      {.arm = "x", .kind = ArmFault::Kind::ignore_stop, .at = at(1s), .lasting = 5s}));
  cell.run_until(at(2s));
  executive.stop({ArmId{0}}, "operator");
  cell.run_until(at(5s));
  EXPECT_TRUE(executive.arms()[0].drives_on);
  EXPECT_FALSE(is_terminal(cell.job("ignores").state));
}

}  // namespace
}  // namespace armloom

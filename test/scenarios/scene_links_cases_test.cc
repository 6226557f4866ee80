// A wall as a link of the arms' URDF, as the link that carries an arm, and as an object of the cell
// must give the same stops and metrics.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "test/collision/walled_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using small::As;

struct Seen final : Observer {
  void on_event(const Event& event) override {
    if (const auto* monitor = std::get_if<MonitorEvent>(&event.body)) found.push_back(*monitor);
  }
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame& frame) override { frames.push_back(frame); }

  std::vector<MonitorEvent> found;
  std::vector<StateFrame> frames;
};

JobRequest swing(double from, double to, double duration_s) {
  JobRequest request{.key = "swing", .name = "", .trajectory = {}};
  request.trajectory.joint_names = {"a_joint1", "a_joint2"};
  request.trajectory.points = {{{from, 0}, {0, 0}, {0, 0}, 0.0},
                               {{to, 0}, {0, 0}, {0, 0}, duration_s}};
  return request;
}

// Returns the angle at which the tip of arm "a" is gap_m from the wall.
double turned_to(double gap_m) { return std::asin((0.4 - 0.03 - gap_m) / 0.6); }

struct WalledRun {
  WalledRun(As as, double gap_m, const std::string& policy) {
    Cell cell = *small::walled(as);
    cell.checking.time_step = 10s;  // timed_discrete checks the ends only
    auto made = Simulation::create(small::shared(cell), ExecutiveOptions{.policy = policy}, seen);
    if (!made) throw std::runtime_error(made.error().front().detail);
    Simulation& simulation = **made;
    JobRequest there = swing(0, turned_to(gap_m), 2);
    const double back = -0.2;
    there.trajectory.points.push_back({{back, 0}, {0, 0}, {0, 0}, 4.0});
    simulation.tick();
    if (!simulation.executive().submit(there)) throw std::runtime_error("refused");
    simulation.run_until(TimePoint(6s));
    job = *simulation.executive().job("swing");
    figures = simulation.executive().figures();
  }

  Seen seen;
  JobView job;
  RunFigures figures{};
};

// If the wall carries the arm, the arm's pedestal belongs to the same link.
std::string named(const std::string& body) { return body == "a_base" ? "wall" : body; }

// Returns the pairs of a frame. Pairs of arm "a" with its mount are in frames only if they are near
// (ClearanceQuery::Closest), so farther ones are left out of all frames.
std::vector<Proximity> comparable(const StateFrame& frame) {
  std::vector<Proximity> pairs = frame.clearance;
  std::erase_if(pairs, [](const Proximity& pair) {
    return pair.arm_a == ArmId{0} && !pair.arm_b && pair.clearance_m >= 0.06;
  });
  return pairs;
}

void expect_same(const WalledRun& link, const WalledRun& object) {
  EXPECT_EQ(link.job.state, object.job.state);
  EXPECT_EQ(link.figures.monitor_stops, object.figures.monitor_stops);
  EXPECT_DOUBLE_EQ(link.figures.min_clearance_m, object.figures.min_clearance_m);
  ASSERT_EQ(link.seen.found.size(), object.seen.found.size());
  for (std::size_t i = 0; i < link.seen.found.size(); ++i) {
    EXPECT_EQ(link.seen.found[i].finding.time, object.seen.found[i].finding.time);
    EXPECT_EQ(link.seen.found[i].stopped, object.seen.found[i].stopped);
    EXPECT_EQ(link.seen.found[i].finding.limit_m, object.seen.found[i].finding.limit_m);
    EXPECT_EQ(link.seen.found[i].finding.proximity.body_b,
              object.seen.found[i].finding.proximity.body_b);
  }
  ASSERT_EQ(link.seen.frames.size(), object.seen.frames.size());
  for (std::size_t i = 0; i < link.seen.frames.size(); ++i) {
    const auto a = comparable(link.seen.frames[i]);
    const auto b = comparable(object.seen.frames[i]);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(named(a[k].body_b), named(b[k].body_b));
      EXPECT_DOUBLE_EQ(a[k].clearance_m, b[k].clearance_m);
    }
  }
}

TEST(SceneLinks, StopTheArmLikeAnEqualObject) {
  for (const As as : {As::link, As::mount}) {
    const WalledRun link(as, 0.005, "timed_discrete");
    const WalledRun object(As::object, 0.005, "timed_discrete");
    expect_same(link, object);
    ASSERT_FALSE(link.seen.found.empty());
    EXPECT_EQ(link.seen.found[0].finding.proximity.body_b, "wall");
    EXPECT_EQ(link.seen.found[0].finding.limit_m, 0.01);
    EXPECT_EQ(link.seen.found[0].stopped, std::vector<std::string>{"a"});
    EXPECT_EQ(link.figures.monitor_stops, link.seen.found.size());
    EXPECT_GE(link.figures.min_clearance_m, 0.01) << "stopped in time";
  }
}

TEST(SceneLinks, AreIncludedInMetricsAndStateFrames) {
  for (const As as : {As::link, As::mount}) {
    const WalledRun link(as, 0.025, "certified");
    const WalledRun object(As::object, 0.025, "certified");
    expect_same(link, object);
    EXPECT_EQ(link.job.state, JobState::succeeded);
    EXPECT_NEAR(link.figures.min_clearance_m, 0.025, 0.001);
    double closest_m = 1.0;
    for (const StateFrame& frame : link.seen.frames) {
      for (const Proximity& near : frame.clearance) {
        if (named(near.body_b) == "wall") closest_m = std::min(closest_m, near.clearance_m);
      }
    }
    EXPECT_DOUBLE_EQ(closest_m, link.figures.min_clearance_m);
  }
}

TEST(SceneLinks, BlockJobsLikeAnEqualObject) {
  for (const std::string policy : {"certified", "reservation", "coordinated", "earliest_start"}) {
    for (const As as : {As::link, As::mount}) {
      const WalledRun link(as, 0.0094, policy);
      const WalledRun object(As::object, 0.0094, policy);
      expect_same(link, object);
      EXPECT_EQ(link.job.state, JobState::backlogged) << policy;
      ASSERT_EQ(link.job.waits_on.size(), 1U) << policy;
      EXPECT_EQ(link.job.waits_on[0].kind, Wait::Kind::object) << policy;
      EXPECT_EQ(link.job.waits_on[0].links, object.job.waits_on[0].links) << policy;
      EXPECT_EQ(link.job.waits_on[0].links[1], "wall") << policy;
    }
  }
}

}  // namespace
}  // namespace armloom

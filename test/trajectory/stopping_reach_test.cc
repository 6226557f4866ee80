#include "core/trajectory/stopping_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trajectory/validate.h"
#include "test/trajectory/test_cell.h"

// Compares stopping_reach_s() with simulated brakes. The joints of `pair` brake with 8 rad/s^2.
namespace armloom {
namespace {

using testing::Knot;
using testing::request_of;
using testing::test_cell;

TrajectoryPtr motion(const Cell& cell, const std::vector<Knot>& knots, bool quintic) {
  TrajectoryRequest request = request_of({"pair_a", "pair_b"}, knots);
  for (WaypointRequest& point : request.points) {
    if (quintic) point.accelerations = {0.0, 0.0};
  }
  return validate(request, cell).value();
}

// Simulates a brake that keeps |q' s'' + q'' r^2| <= brake at every step of 0.01 ms. Returns the
// progress (s) that it takes.
double braked_from(const Trajectory& trajectory, double at_s, double brake) {
  constexpr double kStep_s = 1e-5;
  JointState state;
  double progress_s = at_s;
  double rate = 1.0;
  while (rate > 0.0 && progress_s < to_seconds(trajectory.duration())) {
    trajectory.sample(from_seconds(progress_s), state);
    double change = 50.0;
    for (Eigen::Index j = 0; j < state.velocity.size(); ++j) {
      const double speed = std::abs(state.velocity[j]);
      const double pull = std::abs(state.acceleration[j]) * rate * rate;
      if (speed > 1e-9) change = std::min(change, (brake - pull) / speed);
    }
    progress_s += rate * kStep_s;
    rate -= change * kStep_s;
  }
  return progress_s - at_s;
}

double longest_brake(const Trajectory& trajectory, double brake) {
  double longest_s = 0.0;
  const double duration_s = to_seconds(trajectory.duration());
  for (double at_s = 0.0; at_s < duration_s; at_s += duration_s / 200.0) {
    longest_s = std::max(longest_s, braked_from(trajectory, at_s, brake));
  }
  return longest_s;
}

TEST(StoppingReach, BoundsEverySimulatedBrakeTightly) {
  const Cell cell = test_cell();
  const std::vector<std::vector<Knot>> ways = {
      {{0.0, -1.2, 0.0}, {2.4, 1.2, 0.0}},                  // one long segment
      {{0.0, -2.5, 0.0}, {4.8, 2.5, 0.0}},                  // a longer one
      {{0.0, 0.0, 0.0}, {0.8, 0.5, 1.2}, {1.6, 1.0, 0.0}},  // fast in the middle
      {{0.0, 0.0, 0.0}, {0.5, 0.2, 0.8}, {2.5, 1.8, 0.8}, {3.0, 2.0, 0.0}}};
  for (const auto& way : ways) {
    for (const bool quintic : {false, true}) {
      const TrajectoryPtr trajectory = motion(cell, way, quintic);
      const double brake = cell.joint(trajectory->joints().front()).brake;
      const double taken_s = longest_brake(*trajectory, brake);
      const double reach_s = stopping_reach_s(cell, *trajectory);
      EXPECT_GE(reach_s, taken_s) << to_seconds(trajectory->duration()) << " s, " << quintic;
      EXPECT_LE(reach_s, 1.6 * taken_s) << to_seconds(trajectory->duration()) << " s, " << quintic;
    }
  }
}

}  // namespace
}  // namespace armloom

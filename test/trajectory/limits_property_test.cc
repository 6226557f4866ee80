#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/trajectory/validate.h"
#include "test/trajectory/random_spline.h"
#include "test/trajectory/test_cell.h"

namespace armloom {
namespace {

using testing::random_spline;
using testing::uniform;

// Limits of pair_a and pair_b, with the tolerance of 0.05.
constexpr double kPositionMax = 2.8;
constexpr double kVelocityMax = 2.0 * 1.05;
constexpr double kAccelerationMax = 4.0 * 1.05;

void scale(TrajectoryRequest& request, double factor) {
  for (WaypointRequest& point : request.points) {
    for (auto* row : {&point.positions, &point.velocities, &point.accelerations}) {
      for (double& value : *row) value *= factor;
    }
  }
}

TrajectoryPtr unlimited(const TrajectoryRequest& request, Cell cell) {
  for (Joint& joint : cell.joints) {
    joint.lower = -1e6;
    joint.upper = joint.velocity_max = joint.acceleration_max = 1e6;
  }
  return validate(request, cell).value();
}

struct Peak {
  double position = 0.0, velocity = 0.0, acceleration = 0.0;
  [[nodiscard]] double share() const {
    return std::max(
        {position / kPositionMax, velocity / kVelocityMax, acceleration / kAccelerationMax});
  }
};

// Samples every `step` and both sides of every waypoint.
Peak peak_of(const Trajectory& trajectory, Duration step) {
  Peak peak;
  JointState state;
  const auto look = [&](Duration t) {
    trajectory.sample(t, state);
    peak.position = std::max(peak.position, state.position.cwiseAbs().maxCoeff());
    peak.velocity = std::max(peak.velocity, state.velocity.cwiseAbs().maxCoeff());
    peak.acceleration = std::max(peak.acceleration, state.acceleration.cwiseAbs().maxCoeff());
  };
  for (Duration t{}; t < trajectory.duration(); t += step) look(t);
  for (const Segment& segment : trajectory.segments()) {
    look(segment.start);
    look(segment.start + segment.duration - Duration(1));
  }
  return peak;
}

constexpr Duration kCoarse = std::chrono::milliseconds(2);  // sufficient for scaling
constexpr Duration kDense = std::chrono::microseconds(100);

// Peaks are scaled to just below, just above, or far from a limit.
TEST(LimitsProperty, ValidationAgreesWithDenseSampling) {
  const Cell cell = testing::test_cell();
  std::mt19937_64 random(20240611);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    TrajectoryRequest request =
        random_spline(random, {.reach = 1.0, .shortest_s = 0.2, .longest_s = 1.5}, i % 2 == 1);
    const double before = peak_of(*unlimited(request, cell), kCoarse).share();
    const double targets[] = {0.9985, 1.0005, 1.01, uniform(random, 0.3, 0.99),
                              uniform(random, 1.02, 3.0)};
    const double target = targets[i % 5];
    scale(request, target / before);

    const Peak peak = peak_of(*unlimited(request, cell), kDense);
    const auto result = validate(request, cell);
    (result ? accepted : refused) += 1;
    if (result) {
      EXPECT_LE(peak.position, kPositionMax + kPositionOvershoot + 1e-8);
      EXPECT_LE(peak.velocity, kVelocityMax + 1e-8);
      EXPECT_LE(peak.acceleration, kAccelerationMax + 1e-8);
    }
    if (peak.share() <= 1.0 - 1e-3) {
      EXPECT_TRUE(result) << peak.share() << " " << result.error().front().detail;
    }
  }
  EXPECT_GE(accepted, 200);
  EXPECT_GE(refused, 250);
}

// The reported value must be reached at the reported place.
TEST(LimitsProperty, ReportedValueIsReachedByTheMotion) {
  const Cell cell = testing::test_cell();
  std::mt19937_64 random(7);
  int only_between = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    TrajectoryRequest request =
        random_spline(random, {.reach = 1.0, .shortest_s = 0.2, .longest_s = 1.5}, i % 2 == 1);
    const TrajectoryPtr before = unlimited(request, cell);
    scale(request, 1.001 / peak_of(*before, kCoarse).share());
    const Peak peak = peak_of(*unlimited(request, cell), kDense);
    const auto result = validate(request, cell);
    ASSERT_FALSE(result);
    double share = 0.0;
    bool at_waypoint = false;  // if true, adjacent segments are not searched for their worst value
    for (const Problem& problem : result.error()) {
      const double value = std::abs(std::get<double>(problem.value));
      const double limit = problem.slug == "position-limit"   ? kPositionMax
                           : problem.slug == "velocity-limit" ? kVelocityMax
                                                              : kAccelerationMax;
      EXPECT_GT(value, limit) << problem.detail;
      share = std::max(share, value / limit);
      at_waypoint |= problem.detail.rfind("waypoint ", 0) == 0;
    }
    EXPECT_LE(share, peak.share() + 1e-6);
    if (at_waypoint) continue;
    ++only_between;
    EXPECT_GE(share, peak.share() - 1e-6);
  }
  EXPECT_GE(only_between, 100);
}

}  // namespace
}  // namespace armloom

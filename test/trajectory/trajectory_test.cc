#include "core/trajectory/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "core/trajectory/validate.h"
#include "test/trajectory/test_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using testing::test_cell;

// The interpolation of ROS's joint_trajectory_controller, written independently: Hermite basis
// functions of u = t / T, with two derivatives.
struct Reference {
  double position, velocity, acceleration;
};
Reference hermite_cubic(const WaypointRequest& a, const WaypointRequest& b, std::size_t j, double T,
                        double t) {
  const double p0 = a.positions[j], v0 = a.velocities[j];
  const double p1 = b.positions[j], v1 = b.velocities[j];
  const double u = t / T, u2 = u * u, u3 = u2 * u;
  return {(1 - 3 * u2 + 2 * u3) * p0 + (u - 2 * u2 + u3) * T * v0 + (3 * u2 - 2 * u3) * p1 +
              (u3 - u2) * T * v1,
          ((6 * u2 - 6 * u) * p0 + (1 - 4 * u + 3 * u2) * T * v0 + (6 * u - 6 * u2) * p1 +
           (3 * u2 - 2 * u) * T * v1) /
              T,
          ((12 * u - 6) * p0 + (6 * u - 4) * T * v0 + (6 - 12 * u) * p1 + (6 * u - 2) * T * v1) /
              (T * T)};
}
Reference hermite_quintic(const WaypointRequest& a, const WaypointRequest& b, std::size_t j,
                          double T, double t) {
  const double u = t / T, u2 = u * u, u3 = u2 * u, u4 = u3 * u, u5 = u4 * u;
  const double s[6] = {a.positions[j], a.velocities[j] * T, a.accelerations[j] * T * T,
                       b.positions[j], b.velocities[j] * T, b.accelerations[j] * T * T};
  const double h[6] = {1 - 10 * u3 + 15 * u4 - 6 * u5,
                       u - 6 * u3 + 8 * u4 - 3 * u5,
                       0.5 * u2 - 1.5 * u3 + 1.5 * u4 - 0.5 * u5,
                       10 * u3 - 15 * u4 + 6 * u5,
                       -4 * u3 + 7 * u4 - 3 * u5,
                       0.5 * u3 - u4 + 0.5 * u5};
  const double d[6] = {-30 * u2 + 60 * u3 - 30 * u4,     1 - 18 * u2 + 32 * u3 - 15 * u4,
                       u - 4.5 * u2 + 6 * u3 - 2.5 * u4, 30 * u2 - 60 * u3 + 30 * u4,
                       -12 * u2 + 28 * u3 - 15 * u4,     1.5 * u2 - 4 * u3 + 2.5 * u4};
  const double dd[6] = {-60 * u + 180 * u2 - 120 * u3, -36 * u + 96 * u2 - 60 * u3,
                        1 - 9 * u + 18 * u2 - 10 * u3, 60 * u - 180 * u2 + 120 * u3,
                        -24 * u + 84 * u2 - 60 * u3,   3 * u - 12 * u2 + 10 * u3};
  Reference r{0.0, 0.0, 0.0};
  for (int i = 0; i < 6; ++i) {
    r.position += h[i] * s[i];
    r.velocity += d[i] * s[i] / T;
    r.acceleration += dd[i] * s[i] / (T * T);
  }
  return r;
}

TrajectoryRequest uneven_request(bool with_accelerations) {
  TrajectoryRequest request{{"pair_a", "pair_b"},
                            {{{0.0, 1.0}, {0.0, 0.0}, {0.3, -0.2}, 0.0},
                             {{0.2, 0.8}, {0.3, -0.2}, {0.1, 0.4}, 0.731},
                             {{0.5, 0.7}, {0.1, 0.05}, {-0.3, 0.2}, 1.6},
                             {{0.4, 0.9}, {0.0, 0.0}, {-0.1, 0.3}, 2.9}}};
  if (!with_accelerations) {
    for (WaypointRequest& point : request.points) point.accelerations.clear();
  }
  return request;
}

TrajectoryPtr accepted(const TrajectoryRequest& request) {
  const auto result = validate(request, test_cell());
  if (!result) throw std::runtime_error(result.error().front().detail);
  return *result;
}

// Largest difference over 1000 instants of each segment.
Reference largest_difference(const TrajectoryRequest& request, bool quintic) {
  const TrajectoryPtr trajectory = accepted(request);
  Reference worst{0.0, 0.0, 0.0};
  JointState state;
  for (std::size_t k = 1; k < request.points.size(); ++k) {
    const WaypointRequest& a = request.points[k - 1];
    const WaypointRequest& b = request.points[k];
    const double T = b.time_from_start_s - a.time_from_start_s;
    for (int i = 0; i < 1000; ++i) {
      const double t = T * i / 1000.0;
      const Duration progress = from_seconds(a.time_from_start_s + t);
      const double exact_t = to_seconds(progress) - a.time_from_start_s;
      trajectory->sample(progress, state);
      for (std::size_t j = 0; j < 2; ++j) {
        const Reference r =
            quintic ? hermite_quintic(a, b, j, T, exact_t) : hermite_cubic(a, b, j, T, exact_t);
        const auto row = static_cast<Eigen::Index>(j);
        worst.position = std::max(worst.position, std::abs(state.position[row] - r.position));
        worst.velocity = std::max(worst.velocity, std::abs(state.velocity[row] - r.velocity));
        worst.acceleration =
            std::max(worst.acceleration, std::abs(state.acceleration[row] - r.acceleration));
      }
    }
  }
  return worst;
}

TEST(Trajectory, UsesRosCubicsWithoutAccelerations) {
  const Reference worst = largest_difference(uneven_request(false), false);
  EXPECT_LT(worst.position, 1e-13);
  EXPECT_LT(worst.velocity, 1e-12);
  EXPECT_LT(worst.acceleration, 1e-11);
}

TEST(Trajectory, UsesRosQuinticsWithAccelerations) {
  const Reference worst = largest_difference(uneven_request(true), true);
  EXPECT_LT(worst.position, 1e-13);
  EXPECT_LT(worst.velocity, 1e-12);
  EXPECT_LT(worst.acceleration, 1e-11);
}

TEST(Trajectory, PassesThroughEveryWaypointFromBothSides) {
  const TrajectoryRequest request = uneven_request(true);
  const TrajectoryPtr trajectory = accepted(request);
  JointState state;
  for (std::size_t k = 0; k < request.points.size(); ++k) {
    const WaypointRequest& point = request.points[k];
    for (const Duration offset : {-1ns, 0ns, 1ns}) {
      trajectory->sample(from_seconds(point.time_from_start_s) + offset, state);
      for (std::size_t j = 0; j < 2; ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        EXPECT_NEAR(state.position[row], point.positions[j], 2e-9);
        EXPECT_NEAR(state.velocity[row], point.velocities[j], 2e-9);
        const bool at_rest =  // there is no acceleration outside of the motion
            (k == 0 && offset < 0ns) || (k + 1 == request.points.size() && offset >= 0ns);
        EXPECT_NEAR(state.acceleration[row], at_rest ? 0.0 : point.accelerations[j], 2e-8);
      }
    }
  }
}

TEST(Trajectory, DerivativesAgreeWithFiniteDifferences) {
  const TrajectoryPtr trajectory = accepted(uneven_request(true));
  JointState before, here, after;
  const double h = 1e-5;
  for (int i = 0; i < 390; ++i) {
    const double t = 0.01 + 0.00731 * i;
    trajectory->sample(from_seconds(t - h), before);
    trajectory->sample(from_seconds(t), here);
    trajectory->sample(from_seconds(t + h), after);
    const Eigen::VectorXd velocity = (after.position - before.position) / (2.0 * h);
    const Eigen::VectorXd acceleration = (after.velocity - before.velocity) / (2.0 * h);
    EXPECT_LT((velocity - here.velocity).cwiseAbs().maxCoeff(), 1e-8) << t;
    EXPECT_LT((acceleration - here.acceleration).cwiseAbs().maxCoeff(), 1e-4) << t;
  }
}

TEST(Trajectory, RestsBeforeItsStartAndAfterItsEnd) {
  const TrajectoryPtr trajectory = accepted(uneven_request(true));
  EXPECT_EQ(trajectory->duration(), 2'900ms);
  JointState state;
  for (const Duration progress : {Duration::min(), Duration(-5s), Duration(-1ns)}) {
    trajectory->sample(progress, state);
    EXPECT_EQ(state.position, trajectory->start());
    EXPECT_TRUE(state.velocity.isZero(0.0) && state.acceleration.isZero(0.0));
  }
  for (const Duration progress : {Duration(2'900ms), Duration(1h), Duration::max()}) {
    trajectory->sample(progress, state);
    EXPECT_EQ(state.position, trajectory->goal());
    EXPECT_TRUE(state.velocity.isZero(0.0) && state.acceleration.isZero(0.0));
  }
  EXPECT_EQ(trajectory->start(), Eigen::Vector2d(0.0, 1.0));
  EXPECT_TRUE(trajectory->goal().isApprox(Eigen::Vector2d(0.4, 0.9), 1e-14));
}

TEST(Trajectory, SamplePositionsAgreesWithSample) {
  const TrajectoryPtr trajectory = accepted(testing::quiet_panda_request("left", 100));
  JointState state;
  Eigen::VectorXd position;
  for (Duration t = -20ms; t < 10s; t += 1'234'567ns) {
    trajectory->sample(t, state);
    trajectory->sample_positions(t, position);
    ASSERT_EQ(position, state.position) << to_seconds(t);
  }
}

TEST(Trajectory, FindsTheSegmentForAnyNumberOfSegments) {
  for (std::size_t count = 2; count < 40; ++count) {
    const TrajectoryRequest request = testing::quiet_panda_request("left", 40);
    TrajectoryRequest part{request.joint_names, {}};  // at rest at all waypoints
    for (std::size_t k = 0; k < count; ++k) {
      part.points.push_back(
          {request.points[k].positions, std::vector<double>(7, 0.0), {}, static_cast<double>(k)});
    }
    const TrajectoryPtr trajectory = accepted(part);
    Eigen::VectorXd position;
    for (std::size_t k = 0; k < count; ++k) {
      trajectory->sample_positions(from_seconds(static_cast<double>(k)), position);
      EXPECT_NEAR(position[0], part.points[k].positions[0], 1e-14) << k << " of " << count;
    }
  }
}

TEST(Trajectory, ReusesTheCallersMemory) {
  const TrajectoryPtr trajectory = accepted(uneven_request(true));
  JointState state;
  trajectory->sample(0s, state);
  const double* const place[] = {state.position.data(), state.velocity.data(),
                                 state.acceleration.data()};
  for (const Duration t : {Duration(-1s), Duration(500ms), Duration(2s), Duration(9s)}) {
    trajectory->sample(t, state);
    trajectory->sample_positions(t, state.position);
    EXPECT_EQ(state.position.data(), place[0]);
    EXPECT_EQ(state.velocity.data(), place[1]);
    EXPECT_EQ(state.acceleration.data(), place[2]);
  }
}

Segment segment(Duration start, Duration duration, Eigen::Index rows) {
  Segment result{start, duration, {}};
  result.coefficients.setZero(rows, 6);
  return result;
}

TEST(Trajectory, StoresOnlyCoefficientsAndStarts) {
  constexpr std::size_t kSegments = 10'000;
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < kSegments; ++i) segments.push_back(segment(i * 1ms, 1ms, 2));
  const Trajectory trajectory({JointId(0), JointId(1)}, {ArmId(0)}, std::move(segments));
  const std::size_t numbers = kSegments * (2 * 6 + 1);
  EXPECT_GE(trajectory.bytes(), numbers * sizeof(double));
  EXPECT_LE(trajectory.bytes(), numbers * sizeof(double) + 1024);
  EXPECT_EQ(trajectory.segments().size(), kSegments);
  EXPECT_EQ(trajectory.segment(7).start, 7ms);
  EXPECT_EQ(trajectory.segment(kSegments - 1).duration, 1ms);
}

TEST(Trajectory, ThrowsOnInconsistentParts) {
  const std::vector<JointId> joints = {JointId(0), JointId(1)};
  const std::vector<ArmId> arms = {ArmId(0), ArmId(1)};
  const Segment first = segment(0s, 1s, 2);
  EXPECT_NO_THROW(Trajectory(joints, arms, {first, segment(1s, 1s, 2)}));
  EXPECT_THROW(Trajectory(joints, arms, {}), std::invalid_argument);
  EXPECT_THROW(Trajectory({}, arms, {segment(0s, 1s, 0)}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, {}, {first}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, {ArmId(1), ArmId(0)}, {first}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, {ArmId(1), ArmId(1)}, {first}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, arms, {segment(1s, 1s, 2)}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, arms, {first, segment(2s, 1s, 2)}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, arms, {segment(0s, 0s, 2)}), std::invalid_argument);
  EXPECT_THROW(Trajectory(joints, arms, {segment(0s, 1s, 3)}), std::invalid_argument);
  Segment endless = first;
  endless.coefficients(1, 3) = testing::kInfinity;
  EXPECT_THROW(Trajectory(joints, arms, {endless}), std::invalid_argument);
}

}  // namespace
}  // namespace armloom

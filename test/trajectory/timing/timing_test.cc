#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/trajectory/timing/time_parameterization.h"
#include "test/trajectory/timing/phase_plane.h"
#include "test/trajectory/timing/random_paths.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using testing::curve;
using testing::least_time_s;
using testing::Points;
using testing::random_posture;
using testing::wander;

struct Panda {
  explicit Panda(double jerk) : cell(testing::test_cell()), joints(cell.arms[0].joints) {
    for (Joint& joint : cell.joints) joint.jerk_max = jerk;
    cell.checking.limit_tolerance = 0.0;
  }
  [[nodiscard]] JointRates rates() const { return rates_of(cell, joints); }

  Cell cell;
  std::vector<JointId> joints;
};

// Samples every millisecond, as a controller would; the jerk is the difference of two states.
LimitShares sampled(const Trajectory& trajectory, const JointRates& rates) {
  LimitShares used;
  JointState state, next;
  trajectory.sample(-1ms, state);
  for (Duration t{}; t <= trajectory.duration() + 1ms; t += 1ms) {
    trajectory.sample(t, next);
    for (Eigen::Index j = 0; j < next.position.size(); ++j) {
      used.velocity = std::max(used.velocity, std::abs(next.velocity[j]) / rates.velocity[j]);
      used.acceleration =
          std::max(used.acceleration, std::abs(next.acceleration[j]) / rates.acceleration[j]);
      used.jerk = std::max(used.jerk, std::abs(next.acceleration[j] - state.acceleration[j]) /
                                          0.001 / rates.jerk[j]);
    }
    std::swap(state, next);
  }
  return used;
}

void expect_within(const TimedMotion& timed, const JointRates& rates) {
  const LimitShares at_1_ms = sampled(*timed.trajectory, rates);
  EXPECT_LE(at_1_ms.velocity, 1.0 + 1e-9);
  EXPECT_LE(at_1_ms.acceleration, 1.0 + 1e-9);
  EXPECT_LE(at_1_ms.jerk, 1.0 + 1e-6);
  const LimitShares everywhere = limit_shares(timed.request.points, rates);
  EXPECT_LE(everywhere.velocity, 1.0 + 1e-8);
  EXPECT_LE(everywhere.acceleration, 1.0 + 1e-8);
  EXPECT_LE(everywhere.jerk, 1.0 + 1e-5);
}

void expect_at_rest(const TimedMotion& timed, const Eigen::VectorXd& from,
                    const Eigen::VectorXd& to) {
  const auto& last = timed.request.points.back().positions;
  EXPECT_EQ(timed.trajectory->start(), from);
  EXPECT_EQ(Eigen::Map<const Eigen::VectorXd>(last.data(), to.size()), to);
  for (const WaypointRequest* end : {&timed.request.points.front(), &timed.request.points.back()}) {
    for (std::size_t j = 0; j < end->positions.size(); ++j) {
      EXPECT_EQ(end->velocities[j], 0.0);
      EXPECT_EQ(end->accelerations[j], 0.0);
    }
  }
}

// Returns the duration of the straight line without jerk limit: triangle or trapezoid.
double trapezoid_s(const JointRates& rates, const Eigen::VectorXd& way) {
  const double v = (rates.velocity.array() / way.array().abs()).minCoeff();
  const double a = (rates.acceleration.array() / way.array().abs()).minCoeff();
  return a >= v * v ? 1.0 / v + v / a : 2.0 / std::sqrt(a);
}

TEST(TimedLine, IsNearlyOptimalWithoutJerkAndKeepsAllLimits) {
  const Panda panda(7500.0);
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Eigen::VectorXd from = random_posture(random, panda.cell, panda.joints);
    const Eigen::VectorXd to = random_posture(random, panda.cell, panda.joints);
    const auto timed = time_line(panda.cell, panda.joints, from, to);
    ASSERT_TRUE(timed) << timed.error().front().detail;
    const double bound_s = trapezoid_s(panda.rates(), to - from);
    EXPECT_LE(to_seconds(timed->trajectory->duration()), 1.02 * bound_s);
    EXPECT_GE(to_seconds(timed->trajectory->duration()), bound_s * (1.0 - 1e-9));
    expect_within(*timed, panda.rates());
    expect_at_rest(*timed, from, to);
  }
}

TEST(TimedLine, KeepsJerkLimitsForPathsOfAnyLength) {
  std::mt19937_64 random(4);
  int i = 0;
  for (const double jerk : {3.0, 40.0, 600.0}) {
    const Panda panda(jerk);
    for (const double share : {1.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-12}) {
      SCOPED_TRACE(i++);
      const Eigen::VectorXd from = random_posture(random, panda.cell, panda.joints);
      const Eigen::VectorXd way = random_posture(random, panda.cell, panda.joints) - from;
      const auto timed = time_line(panda.cell, panda.joints, from, from + share * way);
      ASSERT_TRUE(timed) << timed.error().front().detail;
      expect_within(*timed, panda.rates());
      expect_at_rest(*timed, from, from + share * way);
    }
  }
}

TEST(TimedLine, IsStraight) {
  const Panda panda(200.0);
  std::mt19937_64 random(5);
  const Eigen::VectorXd from = random_posture(random, panda.cell, panda.joints);
  const Eigen::VectorXd to = random_posture(random, panda.cell, panda.joints);
  const auto timed = time_line(panda.cell, panda.joints, from, to);
  ASSERT_TRUE(timed);
  JointState state;
  for (Duration t{}; t <= timed->trajectory->duration(); t += 1ms) {
    timed->trajectory->sample(t, state);
    const double share = (state.position[0] - from[0]) / (to[0] - from[0]);
    EXPECT_LE((state.position - (from + share * (to - from))).norm(), 1e-12);
  }
}

TEST(TimedLine, OfZeroLengthHasTheMinimumDuration) {
  const Panda panda(7500.0);
  std::mt19937_64 random(12);
  const Eigen::VectorXd here = random_posture(random, panda.cell, panda.joints);
  const auto timed = time_line(panda.cell, panda.joints, here, here);
  ASSERT_TRUE(timed) << timed.error().front().detail;
  EXPECT_EQ(timed->trajectory->duration(), 10ms);
}

TEST(TimedLine, RejectsGoalsOutsidePositionLimits) {
  const Panda panda(7500.0);
  std::mt19937_64 random(6);
  const Eigen::VectorXd from = random_posture(random, panda.cell, panda.joints);
  Eigen::VectorXd to = from;
  to[3] = 0.5;
  const auto timed = time_line(panda.cell, panda.joints, from, to);
  ASSERT_FALSE(timed);
  EXPECT_EQ(timed.error().front().slug, "position-limit");
}

TEST(TimedPath, IsNearlyOptimalWithoutJerkAndKeepsAllLimits) {
  const Panda panda(7500.0);
  std::mt19937_64 random(7);
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    const Points points = i % 2 == 0 ? curve(random, panda.cell, panda.joints, 100)
                                     : wander(random, panda.cell, panda.joints, 100);
    const JointPath path = JointPath::spline_through(points);
    const auto timed = time_path(panda.cell, panda.joints, path);
    ASSERT_TRUE(timed) << timed.error().front().detail;
    const double least = least_time_s(path, panda.rates(), 20'000);
    EXPECT_LE(to_seconds(timed->trajectory->duration()), 1.05 * least);
    EXPECT_GE(to_seconds(timed->trajectory->duration()), 0.995 * least);
    expect_within(*timed, panda.rates());
    expect_at_rest(*timed, points.front(), points.back());
  }
}

TEST(TimedPath, KeepsJerkLimitsAndStaysNearThePath) {
  std::mt19937_64 random(8);
  for (const double jerk : {20.0, 100.0, 1000.0}) {
    const Panda panda(jerk);
    for (int i = 0; i < 6; ++i) {
      SCOPED_TRACE(i);
      const Points points = curve(random, panda.cell, panda.joints, 100);
      const auto timed = time_path(panda.cell, panda.joints, JointPath::spline_through(points));
      ASSERT_TRUE(timed) << timed.error().front().detail;
      expect_within(*timed, panda.rates());
      expect_at_rest(*timed, points.front(), points.back());
      JointState state;
      Points passed;
      for (Duration t{}; t <= timed->trajectory->duration(); t += 1ms) {
        timed->trajectory->sample(t, state);
        passed.push_back(state.position);
      }
      for (std::size_t k = 0; k < points.size(); k += 9) {
        double nearest = 1.0;
        for (const auto& q : passed) {
          nearest = std::min(nearest, (q - points[k]).lpNorm<Eigen::Infinity>());
        }
        EXPECT_LE(nearest, 1e-3 + 2.2e-3) << "one millisecond is 2.2 mrad at most";
      }
    }
  }
}

TEST(TimedPath, RoundsCornersWithinTheTolerance) {
  const Panda panda(7500.0);
  std::mt19937_64 random(9);
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    Points points;
    while (points.size() < 5) points.push_back(random_posture(random, panda.cell, panda.joints));
    for (const double within : {0.05, 0.3}) {
      const JointPath path = JointPath::rounded(points, within);
      for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        double nearest = 10.0;
        for (int n = 0; n <= 20'000; ++n) {
          nearest =
              std::min(nearest, (path.position(path.length() * n / 20'000) - points[k]).norm());
        }
        EXPECT_LE(nearest, within + 1e-3);
      }
      const auto timed = time_path(panda.cell, panda.joints, path);
      ASSERT_TRUE(timed) << timed.error().front().detail;
      expect_within(*timed, panda.rates());
      const auto stopping = time_lines(panda.cell, panda.joints, points);
      ASSERT_TRUE(stopping);
      expect_within(*stopping, panda.rates());
      EXPECT_LT(timed->trajectory->duration(), stopping->trajectory->duration());
      const double least = least_time_s(path, panda.rates(), 20'000);
      EXPECT_LE(to_seconds(timed->trajectory->duration()), 1.05 * least);
    }
  }
}

TEST(TimedPath, AcceptsPathsThatReverse) {
  const Panda panda(7500.0);
  std::mt19937_64 random(10);
  const Eigen::VectorXd from = random_posture(random, panda.cell, panda.joints, 0.3);
  const Eigen::VectorXd to = random_posture(random, panda.cell, panda.joints, 0.3);
  const auto timed =
      time_path(panda.cell, panda.joints, JointPath::rounded({from, to, from}, 0.01));
  ASSERT_TRUE(timed) << timed.error().front().detail;
  expect_within(*timed, panda.rates());
}

TEST(TimedMotion, IsSlowedByScalingFactors) {
  const Panda panda(7500.0);
  std::mt19937_64 random(11);
  const Points points = curve(random, panda.cell, panda.joints, 30);
  TimingOptions slow;
  slow.shares = {.velocity = 0.5, .acceleration = 0.25};
  const JointPath path = JointPath::spline_through(points);
  const auto whole = time_path(panda.cell, panda.joints, path);
  const auto half = time_path(panda.cell, panda.joints, path, slow);
  ASSERT_TRUE(whole && half);
  EXPECT_NEAR(to_seconds(half->trajectory->duration()),
              2.0 * to_seconds(whole->trajectory->duration()), 0.02);
  expect_within(*half, rates_of(panda.cell, panda.joints, slow.shares));
}

}  // namespace
}  // namespace armloom

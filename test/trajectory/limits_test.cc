#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/trajectory/validate.h"
#include "test/trajectory/test_cell.h"

// Limits of pair_a and pair_b: 2.8 rad, 2 rad/s and 4 rad/s^2; with the tolerance of 0.05, 2.1
// rad/s and 4.2 rad/s^2.
namespace armloom {
namespace {

using testing::Knot;
using testing::quiet_panda_request;
using testing::request_of;
using testing::test_cell;

TrajectoryRequest pair_request(const std::vector<Knot>& knots) {
  return request_of({"pair_a", "pair_b"}, knots);
}

TrajectoryRequest quintic_request(const std::vector<Knot>& knots) {
  TrajectoryRequest request = pair_request(knots);
  for (WaypointRequest& point : request.points) point.accelerations = {0.0, 0.0};
  return request;
}

Problems refused(const TrajectoryRequest& request, const Cell& cell = test_cell()) {
  auto result = validate(request, cell);
  if (result) return {};
  return result.error();
}
bool accepted(const TrajectoryRequest& request) { return refused(request).empty(); }

// Expects the same problem for both joints, which move alike; checks the first.
void expect_between(const TrajectoryRequest& request, const std::string& slug,
                    const std::string& pointer, double value, const std::string& detail) {
  const Problems problems = refused(request);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].slug, slug);
  EXPECT_EQ(problems[0].pointer, pointer);
  EXPECT_EQ(problems[0].detail.substr(0, detail.size()), detail);
  EXPECT_EQ(problems[1].pointer, pointer);
  ASSERT_TRUE(std::holds_alternative<double>(problems[0].value));
  EXPECT_NEAR(std::get<double>(problems[0].value), value, 1e-8);
}

double factor_named_in(const std::string& detail) {
  const std::string name = "\"velocity_scaling_factor\": ";
  const std::size_t at = detail.find(name);
  return at == std::string::npos ? 0.0 : std::stod(detail.substr(at + name.size()));
}

TEST(Limits, RefusalNamesTheLargestScalingFactorThatPasses) {
  TrajectoryRequest fast = pair_request({{0.0, 0.0, 0.0}, {0.5, 0.8, 2.5}, {1.0, 1.6, 0.0}});
  const Problems problems = refused(fast);
  ASSERT_FALSE(problems.empty());
  const double factor = factor_named_in(problems.front().detail);
  ASSERT_GT(factor, 0.1) << problems.front().detail;
  TrajectoryRequest slower = fast;
  slow_down(slower, factor);
  EXPECT_TRUE(accepted(slower));
  slow_down(fast, factor + 0.0015);
  const Problems still = refused(fast);
  ASSERT_FALSE(still.empty()) << "a larger factor passes";
  EXPECT_NEAR(factor_named_in(still.front().detail), factor, 2e-3) << "counts from the original";
}

TEST(Limits, RefusalOfAPositionNamesNoScalingFactor) {
  const Problems problems =
      refused(pair_request({{0.0, 0.0, 0.0}, {0.5, 2.9, 2.5}, {1.0, 1.6, 0.0}}));
  ASSERT_FALSE(problems.empty());
  for (const Problem& problem : problems) EXPECT_EQ(factor_named_in(problem.detail), 0.0);
}

TEST(Limits, TooFastWaypointIsReportedWithPlaceAndValue) {
  TrajectoryRequest request = quiet_panda_request("left");
  request.points[14].velocities[3] = 3.41;
  const Problems problems = refused(request);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0].slug, "velocity-limit");
  EXPECT_EQ(problems[0].pointer, "/points/14/velocities/3");
  EXPECT_EQ(problems[0].value, decltype(Problem::value){3.41});
  const std::string excess = "waypoint 14, left_panda_joint4: 3.41 rad/s exceeds 2.175";
  EXPECT_EQ(problems[0].detail.substr(0, excess.size()), excess);
  // The remaining problems are accelerations of the adjacent segments.
  for (std::size_t i = 1; i < problems.size(); ++i) {
    EXPECT_EQ(problems[i].slug, "acceleration-limit");
  }
}

TEST(Limits, PositionsMayExceedALimitByAMicroradian) {
  EXPECT_TRUE(accepted(pair_request({{0, 0, 0}, {4, 2.8 + 0.9e-6, 0}})));
  const Problems problems = refused(pair_request({{0, 0, 0}, {4, 2.8 + 1.1e-6, 0}}));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[1].slug, "position-limit");
  EXPECT_EQ(problems[1].pointer, "/points/1/positions/1");
  EXPECT_EQ(problems[1].detail, "waypoint 1, pair_b: 2.800001 rad exceeds 2.8");
  EXPECT_EQ(refused(pair_request({{0, -2.9, 0}, {4, 0, 0}}))[0].detail,
            "waypoint 0, pair_a: -2.9 rad is below -2.8");
}

TEST(Limits, VelocityAndAccelerationMayExceedALimitByTheTolerance) {
  // Largest speed 1.5 D / T, in the middle.
  EXPECT_TRUE(accepted(pair_request({{0, -2, 0}, {3, -2 + 4.2, 0}})));
  EXPECT_FALSE(accepted(pair_request({{0, -2, 0}, {3, -2 + 4.2 + 1e-6, 0}})));
  // Largest acceleration 6 D / T^2, at both ends.
  EXPECT_TRUE(accepted(pair_request({{0, 0, 0}, {1, 0.7, 0}})));
  EXPECT_FALSE(accepted(pair_request({{0, 0, 0}, {1, 0.7 + 1e-6, 0}})));

  Cell strict = test_cell();
  strict.checking.limit_tolerance = 0.0;
  EXPECT_TRUE(refused(pair_request({{0, -2, 0}, {3, 2, 0}}), strict).empty());
  EXPECT_FALSE(refused(pair_request({{0, -2, 0}, {3, 2 + 1e-6, 0}}), strict).empty());
}

TEST(Limits, GivenAccelerationsAreCheckedAtTheirWaypoint) {
  TrajectoryRequest request = quintic_request({{0, 0, 0}, {2, 0.5, 0}, {4, 1, 0}});
  request.points[1].accelerations[1] = -4.5;
  const Problems problems = refused(request);
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0].slug, "acceleration-limit");
  EXPECT_EQ(problems[0].pointer, "/points/1/accelerations/1");
  EXPECT_EQ(problems[0].detail.rfind("waypoint 1, pair_b: -4.5 rad/s^2 exceeds 4", 0), 0U);
}

TEST(Limits, FindsExcessVelocityInsideACubic) {
  expect_between(pair_request({{0, -2.2, 0}, {1, -2.2, 0}, {4, 2.3, 0}, {5, 2.3, 0}}),
                 "velocity-limit", "/points/2", 2.25,
                 "between waypoints 1 and 2 (t = 2.5 s), pair_a: 2.25 rad/s exceeds 2");
  expect_between(pair_request({{0, 2.3, 0}, {3, -2.2, 0}}), "velocity-limit", "/points/1", -2.25,
                 "between waypoints 0 and 1 (t = 1.5 s), pair_a: -2.25 rad/s exceeds 2");
}

TEST(Limits, FindsExcessPositionInsideACubic) {
  // From 0.2 rad/s to -0.2 rad/s in 1 s: overshoots 2.79 rad by 0.05 rad.
  const TrajectoryRequest request =
      pair_request({{0, 1.5, 0}, {3, 2.79, 0.2}, {4, 2.79, -0.2}, {7, 1.5, 0}});
  expect_between(request, "position-limit", "/points/2", 2.84,
                 "between waypoints 1 and 2 (t = 3.5 s), pair_a: 2.84 rad exceeds 2.8");
  const auto swing = [](double rad) {
    return pair_request({{0, 2, 0}, {3, 2.8, 4 * rad}, {4, 2.8, -4 * rad}, {7, 2, 0}});
  };
  EXPECT_TRUE(accepted(swing(0.00009)));
  EXPECT_FALSE(accepted(swing(0.00011)));
}

TEST(Limits, ChecksAccelerationOnBothSidesOfAWaypoint) {
  // 6 D / T^2 = 4.5 at the start of the second segment, -4.5 at its end.
  const Problems problems =
      refused(pair_request({{0, 0, 0}, {1, 0, 0}, {2, 0.75, 0}, {3, 0.75, 0}}));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].slug, "acceleration-limit");
  EXPECT_EQ(problems[0].pointer, "/points/2");
  EXPECT_EQ(problems[0].detail.rfind(
                "between waypoints 1 and 2 (t = 1 s), pair_a: 4.5 rad/s^2 exceeds 4", 0),
            0U)
      << problems[0].detail;
}

TEST(Limits, FindsExcessInsideAQuintic) {
  // Minimum jerk: largest speed 1.875 D / T, in the middle.
  expect_between(quintic_request({{0, -1.5, 0}, {3, 2.0, 0}}), "velocity-limit", "/points/1",
                 2.1875, "between waypoints 0 and 1 (t = 1.5 s), pair_a: 2.1875 rad/s exceeds 2");
  // Largest acceleration 10 / sqrt(3) D / T^2 at (1/2 -+ sqrt(3)/6) T.
  const Problems problems = refused(quintic_request({{0, 0, 0}, {1, 0.75, 0}}));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].slug, "acceleration-limit");
  EXPECT_NEAR(std::abs(std::get<double>(problems[0].value)), 7.5 / std::sqrt(3.0), 1e-8);
}

TEST(Limits, ExcessAtAWaypointIsNotRepeatedForItsSegments) {
  const TrajectoryRequest request =
      pair_request({{0, -2.5, 0}, {1.5, -1, 2.3}, {3, 2, 0.5}, {5, 2.5, 0}});
  std::size_t speeds = 0;
  for (const Problem& problem : refused(request)) {
    if (problem.slug != "velocity-limit") continue;
    ++speeds;
    EXPECT_EQ(problem.pointer.rfind("/points/1/velocities/", 0), 0u) << problem.detail;
  }
  EXPECT_EQ(speeds, 2u);
}

TEST(Limits, UsesMetersForPrismaticJointsAndNoBoundsForContinuousJoints) {
  const Problems problems = refused(request_of({"lift"}, {{0, 0, 0}, {1, 0.5, 0}, {9, 1.5, 0}}));
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(problems[0].detail,
            "between waypoints 0 and 1 (t = 0.5 s), lift: 0.75 m/s exceeds 0.5");
  EXPECT_EQ(problems[1].detail, "between waypoints 0 and 1 (t = 0 s), lift: 3 m/s^2 exceeds 2");
  EXPECT_EQ(problems[2].detail, "waypoint 2, lift: 1.5 m exceeds 1");
  EXPECT_TRUE(accepted(request_of({"wheel"}, {{0, 0, 0}, {100, 100, 0}})));
  EXPECT_FALSE(accepted(request_of({"wheel"}, {{0, 0, 0}, {10, 100, 0}})));
}

TEST(Limits, EndsNearlyAtRestBecomeExactlyAtRest) {
  const auto result =
      validate(pair_request({{0, 0, 9e-5}, {1, 0.1, 0.1}, {2, 0.2, -9e-5}}), test_cell());
  ASSERT_TRUE(result);
  JointState state;
  (*result)->sample(Duration::zero(), state);
  EXPECT_TRUE(state.velocity.isZero(0.0));
  (*result)->sample((*result)->duration() - Duration(1), state);
  EXPECT_LT(state.velocity.cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Limits, EndsInMotionAreRejected) {
  Problems problems = refused(pair_request({{0, 0, 2e-4}, {1, 0.1, 0}}));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].slug, "not-at-rest");
  EXPECT_EQ(problems[0].pointer, "/points/0/velocities/0");
  EXPECT_EQ(problems[0].value, decltype(Problem::value){2e-4});
  EXPECT_EQ(problems[0].detail.rfind("waypoint 0, pair_a: 0.0002 rad/s at the start, where the "
                                     "motion must be at rest (0.0001)",
                                     0),
            0U)
      << problems[0].detail;
  problems = refused(pair_request({{0, 0, 0}, {1, 0.1, -0.5}}));
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[1].slug, "not-at-rest");
  EXPECT_EQ(problems[1].pointer, "/points/1/velocities/1");
}

TEST(Limits, OverflowIsRejected) {
  const Problems problems = refused(request_of({"wheel"}, {{0, -1.7e308, 0}, {1, 1.7e308, 0}}));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].slug, "not-finite");
  EXPECT_EQ(problems[0].pointer, "/points/1");
  EXPECT_EQ(problems[0].detail,
            "between waypoints 0 and 1, wheel: too far apart to be interpolated");
  EXPECT_FALSE(accepted(request_of({"wheel"}, {{0, 0, 0}, {1e-6, 1e300, 0}})));
}

TEST(Limits, ReportsAtMostTheMaximumOfProblems) {
  TrajectoryRequest request = quiet_panda_request("left", 100);
  for (WaypointRequest& point : request.points) point.positions[1] = 9.0;
  const Problems problems = refused(request);
  EXPECT_EQ(problems.size(), kProblemsMax);
  EXPECT_EQ(problems[19].pointer, "/points/19/positions/1");
}

}  // namespace
}  // namespace armloom

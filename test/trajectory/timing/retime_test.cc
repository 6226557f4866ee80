#include "core/trajectory/timing/retime.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "test/trajectory/timing/random_paths.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;
using testing::random_posture;

struct Way {
  explicit Way(std::size_t points, std::uint64_t seed = 1) : cell(testing::test_cell()) {
    std::mt19937_64 random(seed);
    for (const JointId joint : cell.arms[0].joints) {
      request.joint_names.push_back(cell.joint(joint).name);
    }
    for (std::size_t i = 0; i < points; ++i) {
      const Eigen::VectorXd at = random_posture(random, cell, cell.arms[0].joints);
      request.points.push_back({.positions = {at.begin(), at.end()}});
    }
    request.retime = TrajectoryRequest::Retime{};
  }
  [[nodiscard]] Result<TrajectoryPtr> read() const { return validate(request, cell); }

  Cell cell;
  TrajectoryRequest request;
};

TEST(Retime, IfNeededKeepsAValidTrajectoryAsGiven) {
  const auto cell = testing::test_cell();
  TrajectoryRequest request = testing::quiet_panda_request("left");
  request.retime = TrajectoryRequest::Retime{.only_if_needed = true};
  const auto kept = validate(request, cell);
  ASSERT_TRUE(kept) << kept.error().front().detail;
  EXPECT_FALSE((*kept)->timed_here());
  for (WaypointRequest& point : request.points) point.time_from_start_s /= 100.0;
  const auto made = validate(request, cell);
  ASSERT_TRUE(made) << made.error().front().detail;
  EXPECT_TRUE((*made)->timed_here());
  EXPECT_NEAR(((*made)->goal() - (*kept)->goal()).norm(), 0.0, 1e-9);
  for (WaypointRequest& point : request.points) point.velocities.clear();
  EXPECT_TRUE(validate(request, cell)) << "times without velocities";
}

TEST(Retime, RestsOnlyAtTheFirstAndLastWaypoint) {
  const Way way(5);
  const auto made = way.read();
  ASSERT_TRUE(made) << made.error().front().detail;
  const Trajectory& motion = **made;
  JointState state;
  for (const auto& [at, point] : {std::pair{Duration{}, way.request.points.front()},
                                  std::pair{motion.duration(), way.request.points.back()}}) {
    motion.sample(at, state);
    for (std::size_t j = 0; j < point.positions.size(); ++j) {
      EXPECT_NEAR(state.position[static_cast<Eigen::Index>(j)], point.positions[j], 1e-9);
    }
    EXPECT_LT(state.velocity.norm(), 1e-6);
  }
  int at_rest = 0;
  const Duration step = motion.duration() / 20;
  for (Duration t = step; t < motion.duration() - step / 2; t += step) {
    motion.sample(t, state);
    at_rest += state.velocity.norm() < 1e-3 ? 1 : 0;
  }
  EXPECT_EQ(at_rest, 0);
}

TEST(Retime, PassesEveryWaypointWithinItsTolerance) {
  const Way way(6, 7);
  const auto made = way.read();
  ASSERT_TRUE(made);
  JointState state;
  for (const WaypointRequest& point : way.request.points) {
    const Eigen::Map<const Eigen::VectorXd> at(point.positions.data(), 7);
    double nearest = 1e9;
    for (Duration t{}; t <= (*made)->duration(); t += std::chrono::milliseconds(1)) {
      (*made)->sample(t, state);
      nearest = std::min(nearest, (state.position - at).norm());
    }
    EXPECT_LT(nearest, kRetimeWithin + 3e-3);  // path deviation and sampling
  }
}

TEST(Retime, ScalesVelocityAndIgnoresVelocitiesAndTimesOfWaypoints) {
  Way way(3);
  const Duration fast = (*way.read())->duration();
  way.request.retime->velocity = 0.1;
  EXPECT_GT((*way.read())->duration(), 2 * fast);
  way.request.retime->velocity = 1.0;
  for (WaypointRequest& point : way.request.points) {
    point.velocities.assign(7, 99.0);
    point.time_from_start_s = -3.0;
  }
  way.request.points.insert(way.request.points.begin() + 1, way.request.points[0]);
  EXPECT_EQ((*way.read())->duration(), fast);
}

TEST(Retime, UsesTheCellsVelocityFactorUnlessTheRequestOverridesIt) {
  Way way(3);
  const Duration fast = (*way.read())->duration();
  way.cell.execution.velocity_scaling_factor = 0.1;
  EXPECT_GT((*way.read())->duration(), 2 * fast);
  way.request.retime->velocity = 1.0;
  EXPECT_EQ((*way.read())->duration(), fast);
}

// Recorded every few milliseconds.
TEST(Retime, AcceptsDenselySampledPaths) {
  Way way(2);
  Eigen::VectorXd middle(7);
  middle << 0.0, -0.4, 0.0, -1.8, 0.0, 1.8, 0.0;
  way.request.points.clear();
  constexpr int kPoints = 9000;
  for (int i = 0; i < kPoints; ++i) {
    const double along = 6.28 * i / kPoints;
    std::vector<double> q(middle.begin(), middle.end());
    q[0] += 0.4 * std::sin(3.0 * along);
    q[1] += 0.3 * std::cos(2.0 * along) - 0.3;
    q[3] += 0.2 * std::sin(5.0 * along);
    way.request.points.push_back({.positions = q});
  }
  const auto made = way.read();
  ASSERT_TRUE(made) << made.error().front().detail;
  JointState state;
  std::vector<Eigen::VectorXd> places;
  for (Duration t{}; t <= (*made)->duration(); t += std::chrono::milliseconds(2)) {
    (*made)->sample(t, state);
    places.push_back(state.position);
  }
  for (std::size_t i = 0; i < way.request.points.size(); i += 50) {
    const Eigen::Map<const Eigen::VectorXd> at(way.request.points[i].positions.data(), 7);
    double nearest = 1e9;
    for (const auto& place : places) nearest = std::min(nearest, (place - at).norm());
    ASSERT_LT(nearest, kRetimeWithin + 4e-3) << i;
  }
  EXPECT_LT(to_seconds((*made)->duration()), 30.0);
}

// Shorter than the thinning distance.
TEST(Retime, KeepsPathsShorterThanTheThinningDistance) {
  Way way(3);
  way.request.points[1] = way.request.points[2] = way.request.points[0];
  way.request.points[1].positions[0] += 0.5 * kThinWithin;
  const auto made = way.read();
  ASSERT_TRUE(made) << made.error().front().detail;
}

TEST(Retime, SuggestsAPartSizeForPathsWithTooManyCorners) {
  Way way(3000);
  const auto made = way.read();
  ASSERT_FALSE(made);
  const Problem& problem = made.error().front();
  EXPECT_EQ(problem.pointer, "/points");
  EXPECT_THAT(problem.detail, HasSubstr("the 3000 waypoints become "));
  const auto begins = problem.detail.find("at most ", problem.detail.find("several jobs"));
  const auto each = static_cast<std::size_t>(std::stoul(problem.detail.substr(begins + 8)));
  EXPECT_GE(each, 100U);
  way.request.points.resize(each);
  const auto part = way.read();
  EXPECT_TRUE(part) << part.error().front().detail;
}

TEST(Retime, ReportsMistakesInTheClientsWaypoints) {
  const auto told = [](const Way& way) {
    const auto made = way.read();
    std::string text;
    for (const Problem& problem : made ? Problems{} : made.error()) {
      text += problem.slug + " " + problem.pointer + ": " + problem.detail + "\n";
    }
    return text;
  };
  Way far(3);
  far.request.points[1].positions[2] = 50.0;
  EXPECT_THAT(told(far), HasSubstr("position-limit /points/1/positions/2: waypoint 1, "));
  Way torn(3);
  torn.request.points[2].positions.pop_back();
  torn.request.points[0].positions[0] = std::nan("");
  EXPECT_THAT(told(torn), HasSubstr("size-mismatch /points/2/positions"));
  EXPECT_THAT(told(torn), HasSubstr("not-finite /points/0/positions/0"));
  Way still(2);
  still.request.points[1] = still.request.points[0];
  EXPECT_THAT(told(still), HasSubstr("no-way /points"));
  for (const double step : {1e-16, 1e-11, 1e-10}) {  // the same position, measured twice
    Way nearly(3);
    nearly.request.points[2] = nearly.request.points[1] = nearly.request.points[0];
    nearly.request.points[1].positions[0] += step;
    EXPECT_THAT(told(nearly), HasSubstr("no-way /points")) << step;
  }
  Way lone(1);
  EXPECT_THAT(told(lone), HasSubstr("too-few-points /points"));
  Way unknown(2);
  unknown.request.joint_names[3] = "elbow";
  EXPECT_THAT(told(unknown), HasSubstr("unknown-joint /joint_names/3"));
}

TEST(Retime, TimesAreRequiredWithoutRetime) {
  Way way(2);
  way.request.retime.reset();
  const auto made = way.read();
  ASSERT_FALSE(made);
  std::string slugs;
  for (const Problem& problem : made.error()) slugs += problem.slug + " ";
  EXPECT_THAT(slugs, HasSubstr("no-time"));
}

}  // namespace
}  // namespace armloom

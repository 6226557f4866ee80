// Defect case T12 and other unusable trajectories.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;

struct BadInput {
  const char* name;
  JobRequest request;
  const char* pointer;
  const char* detail;

  friend void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }
};

JobRequest points(std::vector<WaypointRequest> waypoints) {
  JobRequest request;
  request.trajectory.joint_names = {"x_slide"};
  request.trajectory.points = std::move(waypoints);
  return request;
}

class DegenerateInput : public ::testing::TestWithParam<BadInput> {};

TEST_P(DegenerateInput, IsRefusedWithPlaceAndValue) {
  Crossing cell;
  const std::size_t events = cell.log.events.size();
  const auto refused = cell.simulation->executive().submit(GetParam().request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, GetParam().pointer);
  EXPECT_THAT(refused.error().front().detail, HasSubstr(GetParam().detail));
  cell.run_until(at(500ms));
  EXPECT_TRUE(cell.simulation->executive().all_ended());
  EXPECT_TRUE(cell.simulation->executive().snapshot().jobs.empty());
  EXPECT_EQ(cell.log.events.size(), events);
  EXPECT_EQ(cell.log.last, cell.log.first);
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    Trajectories, DegenerateInput,
    ::testing::Values(
        BadInput{"Empty", points({}), "/trajectory/points", ""},
        BadInput{"OnePointElsewhere", points({{{0}, {0}, {0}, 0}}),
                 "/trajectory/points/0/time_from_start", "retime"},
        BadInput{"EqualTimes", points({{{-1}, {0}, {0}, 0}, {{0}, {0}, {0}, 0}}),
                 "/trajectory/points/1/time_from_start", ""},
        BadInput{"TwoVelocitiesAtOneTime",
                 points({{{-1}, {0}, {0}, 0},
                         {{0}, {0}, {0}, 2},
                         {{0}, {0.1}, {0}, 2},
                         {{1}, {0}, {0}, 4}}),
                 "/trajectory/points/2/time_from_start", ""},
        BadInput{"UnsortedTimes",
                 points({{{-1}, {0}, {0}, 0}, {{0}, {0}, {0}, 2}, {{1}, {0}, {0}, 1}}),
                 "/trajectory/points/2/time_from_start", ""},
        BadInput{"NotANumber", points({{{-1}, {0}, {0}, 0}, {{kNan}, {0}, {0}, 2}}),
                 "/trajectory/points/1/positions/0", ""},
        BadInput{"NotFiniteTime", points({{{-1}, {0}, {0}, 0}, {{0}, {0}, {0}, kInfinity}}),
                 "/trajectory/points/1/time_from_start", ""},
        BadInput{"NoTime", points({{{-1}, {0}, {0}, 0}, {{0}, {0}, {0}, kNan}}),
                 "/trajectory/points/1", ""},
        BadInput{"BeyondAPositionLimit", points({{{-1}, {0}, {0}, 0}, {{2.5}, {0}, {0}, 20}}),
                 "/trajectory/points/1/positions/0", "2.5"},
        BadInput{"TooFastBetweenWaypoints", points({{{-1}, {0}, {0}, 0}, {{1}, {0}, {0}, 1}}),
                 "/trajectory/points/1", "x_slide"},
        BadInput{"StartsElsewhere", points({{{0}, {0}, {0}, 0}, {{1}, {0}, {0}, 4}}),
                 "/trajectory/points/0/positions/0", "begins at 0"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(ConstantTrajectory, Succeeds) {
  Crossing cell;
  cell.submit(slide("x", -1, -1, 1, "stands"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("stands").state, JobState::succeeded);
  EXPECT_EQ(cell.log.last, cell.log.first);
}

TEST(ImplicitStart, IsWhereTheJobBeforeEnds) {
  Crossing cell;
  cell.submit(slide("x", -1, 0.5, 4, "first"));
  cell.submit(points({{{0.8}, {0}, {}, 2}}));
  cell.submit(points({{{0.8}, {0}, {}, 0}}));  // already there
  cell.run_to_the_end();
  EXPECT_NEAR(cell.log.last[0], 0.8, 1e-9);
  for (const JobView& job : cell.simulation->executive().snapshot().jobs) {
    EXPECT_EQ(job.state, JobState::succeeded) << job.key;
  }
}

TEST(ImplicitStart, OfAGoalWithoutAPlanIsRefused) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "moves"));
  JobRequest pose{.key = "pose", .name = "", .trajectory = {}};
  pose.arm = "x";
  pose.move_to = PlanGoal{.pose = PlanPose{}};
  cell.submit(pose);
  const auto refused = cell.simulation->executive().submit(points({{{0.8}, {0}, {}, 2}}));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().slug, "unknown-start");
}

TEST(PredictedRest, OfAnArmThatBrakesIsWhereItWillRest) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "canceled"));
  cell.run_until(at(2s));
  ASSERT_TRUE(cell.simulation->executive().cancel("canceled"));
  cell.simulation->tick();
  const double now_m = cell.log.last[0];
  const auto refused = cell.simulation->executive().submit(slide("x", now_m, 1, 4));
  ASSERT_FALSE(refused) << "the arm comes to rest farther on";
  EXPECT_EQ(refused.error().front().slug, "start-mismatch");
  cell.submit(points({{{-0.5}, {0}, {}, 4}}));  // from where it will rest
  cell.run_to_the_end();
  EXPECT_NEAR(cell.log.last[0], -0.5, 1e-9);
}

TEST(Submit, RefusesAnIdInUse) {
  Crossing cell;
  cell.submit(slide("x", -1, 1, 4, "one"));
  const auto refused = cell.simulation->executive().submit(slide("y", -1, 1, 4, "one"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().kind, ProblemKind::conflict);
}

TEST(Submit, GeneratesUnusedIds) {
  Crossing cell;
  cell.submit(slide("x", -1, -0.5, 4, "job-2"));
  EXPECT_EQ(cell.submit(slide("y", -1, -0.5, 4)).key, "job-2.2");
}

}  // namespace
}  // namespace armloom

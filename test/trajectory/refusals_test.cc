#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/trajectory/validate.h"
#include "test/trajectory/test_cell.h"

// Every rejection with its slug, pointer and value (defect T12 among them).
namespace armloom {
namespace {

using ::testing::HasSubstr;
using testing::kInfinity;
using testing::kNaN;
using testing::quiet_panda_request;
using testing::request_of;
using testing::test_cell;
using Value = decltype(Problem::value);

Problems refused(const TrajectoryRequest& request) {
  auto result = validate(request, test_cell());
  if (result) return {};
  return result.error();
}

void expect_only(const TrajectoryRequest& request, const std::string& slug,
                 const std::string& pointer, const Value& value,
                 ProblemKind kind = ProblemKind::invalid) {
  const Problems problems = refused(request);
  ASSERT_EQ(problems.size(), 1u) << slug;
  EXPECT_EQ(problems[0].slug, slug);
  EXPECT_EQ(problems[0].pointer, pointer);
  EXPECT_EQ(problems[0].value, value) << problems[0].detail;
  EXPECT_EQ(problems[0].kind, kind);
  EXPECT_FALSE(problems[0].detail.empty());
}

TrajectoryRequest pair_request() {
  return request_of({"pair_a", "pair_b"}, {{0.0, 0.0, 0.0}, {1.0, 0.2, 0.1}, {2.0, 0.3, 0.0}});
}

TEST(Validate, KeepsTheJointOrderOfTheRequest) {
  TrajectoryRequest request = quiet_panda_request("right");
  std::swap(request.joint_names[0], request.joint_names[2]);
  for (WaypointRequest& point : request.points) {
    std::swap(point.positions[0], point.positions[2]);
    std::swap(point.velocities[0], point.velocities[2]);
  }
  const Cell cell = test_cell();
  const auto result = validate(request, cell);
  ASSERT_TRUE(result) << result.error().front().detail;
  EXPECT_EQ((*result)->arms(), std::vector<ArmId>{ArmId(1)});
  ASSERT_EQ((*result)->joints().size(), 7u);
  for (std::size_t j = 0; j < 7; ++j) {
    EXPECT_EQ(cell.joint((*result)->joints()[j]).name, request.joint_names[j]);
    EXPECT_EQ((*result)->start()[static_cast<Eigen::Index>(j)], request.points[0].positions[j]);
  }
}

TEST(Validate, AcceptsJointsOfSeveralArmsInAnyOrder) {
  const auto result = validate(
      request_of({"wheel", "pair_b", "lift", "pair_a"}, {{0, 0.1, 0}, {1, 0.2, 0}}), test_cell());
  ASSERT_TRUE(result);
  EXPECT_EQ((*result)->arms(), (std::vector<ArmId>{ArmId(2), ArmId(3), ArmId(4)}));
}

TEST(Validate, AcceptsOptionalGripperJoints) {
  TrajectoryRequest request = quiet_panda_request("left");
  request.joint_names.push_back("left_panda_finger_joint1");
  for (WaypointRequest& point : request.points) {
    point.positions.push_back(0.02);
    point.velocities.push_back(0.0);
  }
  const auto result = validate(request, test_cell());
  ASSERT_TRUE(result) << result.error().front().detail;
  EXPECT_EQ((*result)->joints().size(), 8u);
  EXPECT_EQ((*result)->arms(), std::vector<ArmId>{ArmId(0)});
}

TEST(Validate, RejectsUnknownUnownedAndDuplicateJoints) {
  TrajectoryRequest request = pair_request();
  request.joint_names = {"pair_a", "pair_b", "nobody"};
  for (WaypointRequest& point : request.points) {
    point.positions.push_back(0.0);
    point.velocities.push_back(0.0);
  }
  expect_only(request, "unknown-joint", "/joint_names/2", "nobody");
  request.joint_names[2] = "loose_hinge";
  expect_only(request, "joint-of-no-arm", "/joint_names/2", "loose_hinge");
  request.joint_names[2] = "pair_a";
  expect_only(request, "duplicate-joint", "/joint_names/2", "pair_a");
}

TEST(Validate, RejectsIncompleteArms) {
  expect_only(request_of({"pair_b"}, {{0, 0, 0}, {1, 0.1, 0}}), "missing-joint", "/joint_names",
              1.0);
  // A gripper joint alone requires its arm's joints too.
  EXPECT_EQ(refused(request_of({"left_panda_finger_joint1"}, {{0, 0, 0}, {1, 0.01, 0}})).size(),
            7u);
}

TEST(Validate, RejectsEmptyRequestsAndSingleWaypoints) {
  expect_only(request_of({"pair_a", "pair_b"}, {}), "empty-trajectory", "/points", 0.0);
  expect_only(request_of({"pair_a", "pair_b"}, {{0, 0, 0}}), "too-few-points", "/points", 1.0);
  const Problems problems = refused({});
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].slug, "empty-trajectory");
  EXPECT_EQ(problems[0].pointer, "/joint_names");
  EXPECT_EQ(problems[1].pointer, "/points");
}

TEST(Validate, RejectsMoreThanTheMaximumOfWaypoints) {
  TrajectoryRequest request = pair_request();
  request.points.clear();
  for (std::size_t k = 0; k < kWaypointsMax; ++k) {
    request.points.push_back({{0.1, 0.1}, {0.0, 0.0}, {}, 0.01 * static_cast<double>(k)});
  }
  EXPECT_TRUE(validate(request, test_cell()));
  request.points.push_back(request.points.back());
  expect_only(request, "too-many-points", "/points", 10'001.0, ProblemKind::too_large);
}

TEST(Validate, RejectsRowsOfTheWrongSize) {
  TrajectoryRequest request = pair_request();
  request.points[1].positions.push_back(0.0);
  expect_only(request, "size-mismatch", "/points/1/positions", 3.0);
  request = pair_request();
  request.points[2].positions.clear();
  expect_only(request, "size-mismatch", "/points/2/positions", 0.0);
  request = pair_request();
  request.points[0].velocities.pop_back();
  expect_only(request, "size-mismatch", "/points/0/velocities", 1.0);
  request = pair_request();
  for (WaypointRequest& point : request.points) point.accelerations = {0.0, 0.0};
  request.points[1].accelerations = {0.0, 0.0, 0.0, 0.0};
  expect_only(request, "size-mismatch", "/points/1/accelerations", 4.0);
}

TEST(Validate, RejectsMissingVelocitiesAndPartialAccelerations) {
  TrajectoryRequest request = pair_request();
  request.points[1].velocities.clear();
  expect_only(request, "no-velocities", "/points/1", Value{});
  for (WaypointRequest& point : request.points) point.velocities.clear();
  expect_only(request, "no-velocities", "/points/0", Value{});

  request = pair_request();
  request.points.front().velocities.clear();
  request.points.back().velocities.clear();
  EXPECT_TRUE(validate(request, test_cell())) << "the motion is at rest at its ends";

  request = pair_request();
  request.points[0].accelerations = {0.0, 0.0};
  request.points[2].accelerations = {0.0, 0.0};
  expect_only(request, "partial-accelerations", "/points/1", Value{});
  request.points[1].accelerations = {0.0, 0.0};
  EXPECT_TRUE(validate(request, test_cell()));
}

TEST(Validate, RejectsNonFiniteNumbers) {
  TrajectoryRequest request = pair_request();
  request.points[1].positions[1] = kNaN;
  expect_only(request, "not-finite", "/points/1/positions/1", "nan");
  request.points[1].positions[1] = -std::abs(kNaN);
  expect_only(request, "not-finite", "/points/1/positions/1", "nan");
  request = pair_request();
  request.points[2].velocities[0] = kInfinity;
  expect_only(request, "not-finite", "/points/2/velocities/0", "inf");
  request = pair_request();
  for (WaypointRequest& point : request.points) point.accelerations = {0.0, 0.0};
  request.points[0].accelerations[1] = -kInfinity;
  expect_only(request, "not-finite", "/points/0/accelerations/1", "-inf");
  request = pair_request();
  request.points[1].time_from_start_s = kInfinity;
  expect_only(request, "not-finite", "/points/1/time_from_start", "inf");
}

TEST(Validate, RejectsTimesThatDoNotStartAtZero) {
  TrajectoryRequest request = pair_request();
  request.points[0].time_from_start_s = 0.25;
  expect_only(request, "first-time-not-zero", "/points/0/time_from_start", 0.25);
  request.points[0].time_from_start_s = -0.25;
  expect_only(request, "negative-time", "/points/0/time_from_start", -0.25);
  request.points[0].time_from_start_s = -1e300;
  expect_only(request, "negative-time", "/points/0/time_from_start", -1e300);
  request.points[0].time_from_start_s = 1e-10;  // rounding error below half a nanosecond
  EXPECT_TRUE(validate(request, test_cell()));
  request.points[0].time_from_start_s = -0.0;
  EXPECT_TRUE(validate(request, test_cell()));
}

// Planners that join segments print the state at a joint twice.
TEST(Validate, DropsWaypointsThatRepeatTheirPredecessor) {
  const auto plain = validate(pair_request(), test_cell());
  ASSERT_TRUE(plain);
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double later_s : {0.0, 3e-9, 9e-7}) {
      TrajectoryRequest request = pair_request();
      WaypointRequest again = request.points[k];
      again.time_from_start_s += later_s;
      request.points.insert(request.points.begin() + static_cast<std::ptrdiff_t>(k) + 1, again);
      const auto read = validate(request, test_cell());
      ASSERT_TRUE(read) << k << ", " << later_s << ": " << read.error().front().detail;
      EXPECT_EQ((*read)->segment_count(), (*plain)->segment_count());
      EXPECT_EQ((*read)->goal(), (*plain)->goal());
    }
  }
}

TEST(Validate, RejectsEqualTimesOfDifferentStates) {
  TrajectoryRequest request = pair_request();
  request.points.insert(request.points.begin() + 2, request.points[1]);
  request.points[2].velocities[0] += 0.01;
  expect_only(request, "time-not-increasing", "/points/2/time_from_start", 1.0);
  EXPECT_THAT(refused(request)[0].detail, HasSubstr("\"retime\": true"));
}

TEST(Validate, ReadsJointNamesWithoutPrefixIfTheArmIsNamed) {
  Cell cell = test_cell();
  cell.robots.resize(2);
  cell.robots[0].prefix = "left_";
  cell.robots[1].prefix = "right_";
  cell.arms[1].robot = RobotId(1);
  TrajectoryRequest request = quiet_panda_request("left");
  for (std::string& name : request.joint_names) name = name.substr(std::string("left_").size());
  const auto refused = validate(request, cell);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error()[0].detail,
              HasSubstr("write left_panda_joint1 or right_panda_joint1, or name the arm"));
  request.arm = "left";
  const auto read = validate(request, cell);
  ASSERT_TRUE(read) << read.error().front().detail;
  EXPECT_EQ((*read)->arms(), std::vector<ArmId>{ArmId(0)});
}

TEST(Validate, SuggestsTheNearestJointForAMisspeltName) {
  TrajectoryRequest request = quiet_panda_request("left");
  request.joint_names[3] = "left_panda_jiont4";
  EXPECT_THAT(refused(request)[0].detail, HasSubstr("did you mean left_panda_joint4?"));
}

TEST(Validate, RejectsEqualDecreasingAndTooCloseTimes) {
  TrajectoryRequest request = pair_request();
  request.points[1].time_from_start_s = 0.0;
  expect_only(request, "time-not-increasing", "/points/1/time_from_start", 0.0);
  request = pair_request();
  request.points[2].time_from_start_s = 0.5;
  expect_only(request, "time-not-increasing", "/points/2/time_from_start", 0.5);
  request.points[2].time_from_start_s = 1.0 + 9e-7;
  expect_only(request, "time-not-increasing", "/points/2/time_from_start", 1.0 + 9e-7);
  EXPECT_THAT(refused(request)[0].detail,
              HasSubstr("is 9e-07 s after waypoint 1; at least 1e-06 s is needed"));
}

TEST(Validate, SamplesTheShortestSegmentExactly) {
  const auto result = validate(
      request_of({"pair_a", "pair_b"}, {{0, 0.5, 0}, {kSegmentMin_s, 0.5, 0}}), test_cell());
  ASSERT_TRUE(result);
  JointState state;
  for (int ns = -1; ns <= 1001; ++ns) {
    (*result)->sample(Duration(ns), state);
    EXPECT_EQ(state.position, Eigen::Vector2d(0.5, 0.5));
    EXPECT_TRUE(state.velocity.isZero(0.0) && state.acceleration.isZero(0.0));
  }
}

TEST(Validate, RejectsMotionsLongerThanTheMaximum) {
  TrajectoryRequest request = pair_request();
  request.points[1].velocities = {0.0, 0.0};
  request.points[2].time_from_start_s = kDurationMax_s;
  EXPECT_TRUE(validate(request, test_cell()));
  request.points[2].time_from_start_s = 3600.5;
  expect_only(request, "too-long", "/points/2/time_from_start", 3600.5);
  request.points[2].time_from_start_s = 1e300;
  expect_only(request, "too-long", "/points/2/time_from_start", 1e300);
}

TEST(Validate, ReportsWhyAJointHasNoValueOfItsOwn) {
  Cell cell = test_cell();
  cell.robots.emplace_back().joints_without_value = {{"torso", "is held at 0.3"},
                                                     {"finger", "follows thumb"}};
  const auto why = [&](const std::string& joint) {
    TrajectoryRequest request = pair_request();
    request.joint_names.push_back(joint);
    const auto result = validate(request, cell);
    return result ? "" : result.error().front().detail;
  };
  EXPECT_EQ(why("torso"), "joint torso is held at 0.3, and has no value of its own: leave it out");
  EXPECT_EQ(why("finger"), "joint finger follows thumb, and has no value of its own: leave it out");
}

TEST(Validate, ReturnsAllProblemsUpToTheMaximum) {
  TrajectoryRequest request = pair_request();
  request.joint_names[1] = "pair_x";
  request.points[1].positions.pop_back();
  request.points[2].time_from_start_s = 1.0;
  const Problems problems = refused(request);
  std::vector<std::string> slugs;
  for (const Problem& problem : problems) slugs.push_back(problem.slug);
  EXPECT_EQ(slugs, (std::vector<std::string>{"unknown-joint", "missing-joint", "size-mismatch",
                                             "time-not-increasing"}));

  request = quiet_panda_request("left", 50);
  for (WaypointRequest& point : request.points) point.positions.pop_back();
  EXPECT_EQ(refused(request).size(), kProblemsMax);
}

}  // namespace
}  // namespace armloom

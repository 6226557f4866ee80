#include "core/trajectory/implicit_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/trajectory/joint_line.h"
#include "test/trajectory/test_cell.h"

namespace armloom {
namespace {

using ::testing::HasSubstr;
using testing::kNaN;
using testing::request_of;
using testing::test_cell;

Configuration at_zero(const Cell& cell) {
  return Configuration::Zero(static_cast<Eigen::Index>(cell.joints.size()));
}

Result<TrajectoryPtr> validated(const TrajectoryRequest& request, const Cell& cell,
                                const Configuration& rest) {
  EXPECT_TRUE(has_implicit_start(request, cell));
  const auto complete = with_implicit_start(request, cell, rest);
  if (!complete) return failure(complete.error());
  return validate(*complete, cell);
}

TEST(ImplicitStart, LeadsFromRestToTheFirstWaypoint) {
  const Cell cell = test_cell();
  auto request = request_of({"pair_a", "pair_b"}, {{1.0, 0.2, 0.1}, {2.0, 0.3, 0.0}});
  Configuration rest = at_zero(cell);
  rest[static_cast<Eigen::Index>(cell.find_joint("pair_b")->index())] = 0.05;
  const auto motion = validated(request, cell, rest);
  ASSERT_TRUE(motion) << motion.error().front().detail;
  EXPECT_EQ((*motion)->segment_count(), 2u);
  EXPECT_EQ((*motion)->start(), Eigen::Vector2d(0.0, 0.05));
  EXPECT_EQ(to_seconds((*motion)->duration()), 2.0);
}

TEST(ImplicitStart, NamesWaypointsAsTheClientCounts) {
  const Cell cell = test_cell();
  const auto request = request_of({"pair_a", "pair_b"}, {{1.0, 0.2, 0.1}, {2.0, 9.0, 0.0}});
  const auto refused = validated(request, cell, at_zero(cell));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, "/points/1/positions/0");
  EXPECT_THAT(refused.error().front().detail, HasSubstr("waypoint 1, pair_a"));
  auto fast = request_of({"pair_a", "pair_b"}, {{0.01, 0.2, 0.0}, {2.0, 0.3, 0.0}});
  const auto too_fast = validated(fast, cell, at_zero(cell));
  ASSERT_FALSE(too_fast);
  EXPECT_EQ(too_fast.error().front().pointer, "/points/0");
  EXPECT_THAT(too_fast.error().front().detail,
              HasSubstr("between the arm's position at the start and waypoint 0"));
}

TEST(ImplicitStart, ReachesASingleWaypointWithoutVelocities) {
  const Cell cell = test_cell();
  auto request = request_of({"pair_a", "pair_b"}, {{3.0, 0.4, 0.0}});
  request.points[0].velocities.clear();
  const auto motion = validated(request, cell, at_zero(cell));
  ASSERT_TRUE(motion) << motion.error().front().detail;
  EXPECT_NEAR((*motion)->goal()[0], 0.4, 1e-12);
  EXPECT_EQ(to_seconds((*motion)->duration()), 3.0);
}

TEST(ImplicitStart, TimesASingleWaypointWithRetime) {
  const Cell cell = test_cell();
  auto request = request_of({"pair_a", "pair_b"}, {{kNaN, 0.4, 0.0}});
  request.retime.emplace();
  const auto motion = validated(request, cell, at_zero(cell));
  ASSERT_TRUE(motion) << motion.error().front().detail;
  EXPECT_NEAR((*motion)->goal()[0], 0.4, 1e-9);
}

TEST(ImplicitStart, SucceedsWhereTheArmIsAlready) {
  const Cell cell = test_cell();
  auto request = request_of({"pair_a", "pair_b"}, {{0.0, 0.001, 0.0}});
  const auto motion = validated(request, cell, at_zero(cell));
  ASSERT_TRUE(motion) << motion.error().front().detail;
  EXPECT_EQ((*motion)->start(), (*motion)->goal());
  EXPECT_EQ((*motion)->duration(), kLineMin);
}

TEST(ImplicitStart, AsksForTheTimeToASingleWaypointElsewhere) {
  const Cell cell = test_cell();
  const auto refused =
      validated(request_of({"pair_a", "pair_b"}, {{0.0, 0.5, 0.0}}), cell, at_zero(cell));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().pointer, "/points/0/time_from_start");
  EXPECT_THAT(refused.error().front().detail, HasSubstr("retime"));
}

TEST(ImplicitStart, KeepsTheArmInPlaceIfOnlyItsFingersAreNamed) {
  const Cell cell = test_cell();
  Configuration rest = at_zero(cell);
  for (const JointId joint : cell.arm(ArmId(1)).joints) {
    rest[static_cast<Eigen::Index>(joint.index())] = -0.5;
  }
  const auto request =
      request_of({"right_panda_finger_joint1"}, {{0.0, 0.0, 0.0}, {1.0, 0.03, 0.0}});
  rest[static_cast<Eigen::Index>(cell.find_joint("right_panda_joint6")->index())] = 0.5;
  const auto motion = validated(request, cell, rest);
  ASSERT_TRUE(motion) << motion.error().front().detail;
  EXPECT_EQ((*motion)->arms(), std::vector<ArmId>{ArmId(1)});
  ASSERT_EQ((*motion)->joints().size(), 8u);
  EXPECT_NEAR((*motion)->goal()[0], 0.03, 1e-12);
  EXPECT_EQ((*motion)->start().tail(7), (*motion)->goal().tail(7));
  EXPECT_EQ((*motion)->start()[1], -0.5);
}

TEST(ImplicitStart, IsNotSupposedOtherwise) {
  const Cell cell = test_cell();
  const auto complete = request_of({"pair_a", "pair_b"}, {{0.0, 0.0, 0.0}, {1.0, 0.1, 0.0}});
  EXPECT_FALSE(has_implicit_start(complete, cell));
  const auto half = request_of({"pair_a"}, {{0.0, 0.0, 0.0}, {1.0, 0.1, 0.0}});
  EXPECT_FALSE(has_implicit_start(half, cell));
  auto retimed = request_of({"pair_a", "pair_b"}, {{1.0, 0.0, 0.0}, {2.0, 0.1, 0.0}});
  retimed.retime.emplace();
  EXPECT_FALSE(has_implicit_start(retimed, cell));
}

}  // namespace
}  // namespace armloom

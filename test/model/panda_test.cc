#include <gmock/gmock.h>

#include <chrono>

#include "core/model/kinematics.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

TEST(Panda, HasSevenJointsAndOneGripperJoint) {
  const CellPtr cell = build_or_fail(two_pandas_description());
  ASSERT_EQ(cell->arms.size(), 2u);
  ASSERT_EQ(cell->joints.size(), 16u);
  EXPECT_THAT(names_of(*cell, cell->arms[1].joints),
              testing::ElementsAre("right_panda_joint1", "right_panda_joint2", "right_panda_joint3",
                                   "right_panda_joint4", "right_panda_joint5", "right_panda_joint6",
                                   "right_panda_joint7"));
  EXPECT_THAT(names_of(*cell, cell->arms[0].gripper_joints),
              testing::ElementsAre("left_panda_finger_joint1"));
  EXPECT_TRUE(cell->arms[0].named_states.contains("ready"));
}

// Positions in rad, velocities in rad/s.
TEST(Panda, HasTheManufacturersLimits) {
  const CellPtr cell = build_or_fail(two_pandas_description());
  const double lower[] = {-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973};
  const double upper[] = {2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973};
  const double velocity[] = {2.1750, 2.1750, 2.1750, 2.1750, 2.6100, 2.6100, 2.6100};
  for (std::size_t j = 0; j < 7; ++j) {
    const Joint& joint = cell->joint(cell->arms[0].joints[j]);
    EXPECT_NEAR(joint.lower, lower[j], 1e-4) << joint.name;
    EXPECT_NEAR(joint.upper, upper[j], 1e-4) << joint.name;
    EXPECT_NEAR(joint.velocity_max, velocity[j], 1e-4) << joint.name;
    EXPECT_EQ(joint.acceleration_max, kDefaultAcceleration);
    EXPECT_EQ(joint.brake, 2 * kDefaultAcceleration);
  }
}

TEST(Panda, FlangePoseAtZeroMatchesTheDataSheet) {
  const CellPtr cell = build_or_fail(two_pandas_description());
  LinkPoses X_WL;
  forward_kinematics(*cell, Configuration::Zero(16), X_WL);
  for (const std::string arm : {"left", "right"}) {
    const Eigen::Isometry3d& X_W0 = X_WL[cell->find_link(arm + "_panda_link0")->index()];
    const Eigen::Isometry3d& X_W8 = X_WL[cell->find_link(arm + "_panda_link8")->index()];
    const Eigen::Isometry3d X_08 = X_W0.inverse() * X_W8;
    EXPECT_TRUE(X_08.translation().isApprox(Eigen::Vector3d(0.088, 0, 0.926), 1e-6))
        << X_08.translation().transpose();
    // The flange points down: x forward, z towards the floor.
    EXPECT_NEAR(X_08.linear()(0, 0), 1.0, 1e-6);
    EXPECT_NEAR(X_08.linear()(2, 2), -1.0, 1e-6);
  }
}

TEST(Panda, AllowsBothBasesToTouchTheTable) {
  const CellPtr cell = build_or_fail(two_pandas_description());
  EXPECT_TRUE(cell->allowed.link_objects.contains({*cell->find_link("left_panda_link0"), "table"}));
  EXPECT_TRUE(
      cell->allowed.link_objects.contains({*cell->find_link("right_panda_link0"), "table"}));
  EXPECT_EQ(cell->allowed.link_objects.size(), 2u);
}

TEST(Panda, CellOfTwoBuildsInUnderFiftyMilliseconds) {
  const CellDescription description = two_pandas_description();
  auto best = std::chrono::steady_clock::duration::max();
  for (int round = 0; round < 5; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    const CellPtr cell = build_or_fail(description);
    best = std::min(best, std::chrono::steady_clock::now() - begin);
  }
  EXPECT_LT(best, std::chrono::milliseconds(50));
}

}  // namespace
}  // namespace armloom

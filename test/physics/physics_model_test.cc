#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "server/physics/robot_dynamics.h"

namespace armloom::test {
namespace {

TEST(InertiaOfShapes, MatchesTheFormulaOfACylinder) {
  const double r = 0.05;
  const double h = 0.3;
  Eigen::Isometry3d X_LS = Eigen::Isometry3d::Identity();
  X_LS.translation() = Eigen::Vector3d(0.1, -0.2, 0.3);
  const LinkInertia found = inertia_of_shapes({{Cylinder{r, h}, X_LS}}, 1000.0);
  const double mass = 1000.0 * std::numbers::pi * r * r * h;
  EXPECT_NEAR(found.mass_kg, mass, 0.03 * mass);
  EXPECT_LT((found.p_LC - X_LS.translation()).norm(), 1e-3);
  const double across = mass * (3.0 * r * r + h * h) / 12.0;
  EXPECT_NEAR(found.I_C_kg_m2(0, 0), across, 0.05 * across);
  EXPECT_NEAR(found.I_C_kg_m2(2, 2), mass * r * r / 2.0, 0.05 * mass * r * r);
  EXPECT_TRUE(found.is_possible());
}

TEST(InertiaOfShapes, CountsOverlappingVolumeOnce) {
  const PlacedShape box{Box{{0.2, 0.1, 0.1}}};
  EXPECT_NEAR(inertia_of_shapes({box, box, {Sphere{0.04}}}, 500.0).mass_kg, 1.0, 1e-9);
}

constexpr const char* kUrdf = R"(<robot name="r">
  <link name="base"/>
  <link name="arm"><inertial><origin xyz="0.1 0 0" rpy="0 0 1.5707963267948966"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="odd"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="3" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j1" type="revolute"><parent link="base"/><child link="arm"/>
    <limit lower="-1" upper="1" velocity="1" effort="50"/><dynamics damping="0.5" friction="2"/></joint>
  <joint name="j2" type="revolute"><parent link="arm"/><child link="odd"/>
    <limit lower="-1" upper="1" velocity="1" effort="-3"/></joint>
</robot>)";

TEST(RobotDynamics, ReadsInertiaEffortAndLosses) {
  Problems warnings;
  const RobotDynamics dynamics = read_dynamics(kUrdf, "r1", warnings);
  const LinkInertia& arm = dynamics.links.at("arm");
  EXPECT_EQ(arm.mass_kg, 2.0);
  EXPECT_EQ(arm.p_LC, Eigen::Vector3d(0.1, 0, 0));
  EXPECT_NEAR(arm.I_C_kg_m2(0, 0), 0.2, 1e-12);  // the origin is turned by 90 degrees
  EXPECT_NEAR(arm.I_C_kg_m2(1, 1), 0.1, 1e-12);
  EXPECT_EQ(dynamics.joints.at("arm").effort_max, 50.0);
  EXPECT_EQ(dynamics.joints.at("arm").damping, 0.5);
  EXPECT_EQ(dynamics.joints.at("arm").friction, 2.0);
}

TEST(RobotDynamics, ReportsImpossibleValuesAndLeavesThemOut) {
  Problems warnings;
  const RobotDynamics dynamics = read_dynamics(kUrdf, "r1", warnings);
  EXPECT_FALSE(dynamics.links.contains("odd"));
  EXPECT_FALSE(dynamics.joints.at("odd").effort_max.has_value());
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[0].pointer, testing::HasSubstr("link odd"));
  EXPECT_THAT(warnings[1].pointer, testing::HasSubstr("joint j2"));
}

}  // namespace
}  // namespace armloom::test

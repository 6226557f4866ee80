#include "core/planning/pose_goal.h"

#include <gtest/gtest.h>

#include <random>

#include "core/model/kinematics.h"
#include "test/planning/wall_cell.h"

namespace armloom {
namespace {

using testing::WallCell;

TEST(PoseGoal, SolutionReachesThePose) {
  const WallCell wall;
  const LinkId tool = *wall.cell->find_link("left_panda_hand");
  std::mt19937_64 random(31);
  LinkPoses X_WL;
  int reached = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Configuration q = wall.cell->home();
    for (const JointId id : wall.cell->arm(wall.left).joints) {
      const Joint& joint = wall.cell->joint(id);
      q[static_cast<Eigen::Index>(id.index())] =
          std::uniform_real_distribution(joint.lower, joint.upper)(random);
    }
    forward_kinematics(*wall.cell, q, X_WL);
    const Eigen::Isometry3d X_WT = X_WL[tool.index()];
    const auto found = reach_pose(*wall.cell, {wall.left, tool, X_WT}, wall.cell->home());
    if (!found) continue;
    ++reached;
    double nearest = 0.0;
    for (const Eigen::VectorXd& own : *found) {
      forward_kinematics(*wall.cell, wall.standing(own), X_WL);
      const Eigen::Isometry3d off = X_WL[tool.index()].inverse() * X_WT;
      EXPECT_LE(off.translation().norm(), 1e-4);
      EXPECT_LE(Eigen::AngleAxisd(off.linear()).angle(), 1e-4);
      for (Eigen::Index j = 0; j < 7; ++j) {
        const Joint& joint =
            wall.cell->joint(wall.cell->arm(wall.left).joints[static_cast<std::size_t>(j)]);
        EXPECT_GE(own[j], joint.lower);
        EXPECT_LE(own[j], joint.upper);
      }
      EXPECT_GE((own - wall.home()).norm(), nearest) << "the nearest first";
      nearest = (own - wall.home()).norm();
    }
  }
  EXPECT_GE(reached, 99) << "of 100 that can be reached";
}

TEST(PoseGoal, ReportsTheRemainingDistance) {
  const WallCell wall;
  const LinkId tool = *wall.cell->find_link("left_panda_hand");
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() = Eigen::Vector3d(3.0, 0.0, 0.5);
  const auto found = reach_pose(*wall.cell, {wall.left, tool, X_WT}, wall.cell->home());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().reason, PlanRefusal::Reason::goal_not_reached);
  EXPECT_NE(found.error().detail.find("mm"), std::string::npos) << found.error().detail;
}

TEST(PoseGoal, RejectsALinkThatTheArmDoesNotMove) {
  const WallCell wall;
  for (const char* name : {"left_panda_link0", "right_panda_hand"}) {
    const auto found = reach_pose(
        *wall.cell, {wall.left, *wall.cell->find_link(name), Eigen::Isometry3d::Identity()},
        wall.cell->home());
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().detail.find(name), std::string::npos);
  }
}

TEST(PoseGoal, SolvesForOtherArmsThanPandas) {
  const CellPtr cell = build_or_fail(two_arms_description());
  LinkPoses X_WL;
  for (std::uint32_t a = 0; a < cell->arms.size(); ++a) {
    const Arm& arm = cell->arms[a];
    Configuration q = cell->home();
    for (const JointId id : arm.joints) {
      q[static_cast<Eigen::Index>(id.index())] += 0.2;
    }
    std::optional<LinkId> last;
    for (const LinkId id : arm.links) {
      if (cell->link(id).driver == arm.joints.back() && !last) last = id;
    }
    ASSERT_TRUE(last);
    forward_kinematics(*cell, q, X_WL);
    const Eigen::Isometry3d X_WT = X_WL[last->index()];
    const auto found = reach_pose(*cell, {ArmId{a}, *last, X_WT}, cell->home());
    ASSERT_TRUE(found) << found.error().detail;
  }
}

}  // namespace
}  // namespace armloom

#include "core/planning/plan_goal.h"

#include <gtest/gtest.h>

#include "test/planning/wall_cell.h"

namespace armloom {
namespace {

using testing::WallCell;

TEST(PlanGoal, UsesTheCellsVelocityFactor) {
  const WallCell wall;
  Cell slow = *wall.cell;
  slow.execution.velocity_scaling_factor = 0.3;
  const PlanGoal home{.joints = {}, .named = "home", .pose = {}};
  const PlanGoal pose{.joints = {}, .named = {}, .pose = PlanPose{}};
  EXPECT_EQ(goal_of(*wall.cell, wall.left, home)->speed, 1.0);
  EXPECT_EQ(goal_of(slow, wall.left, home)->speed, 0.3);
  EXPECT_EQ(goal_of(slow, wall.left, pose)->speed, 0.3);
}

}  // namespace
}  // namespace armloom

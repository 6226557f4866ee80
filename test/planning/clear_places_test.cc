#include "core/planning/clear_places.h"

#include "core/collision/check/motion_checker.h"
#include "core/planning/answer_plan.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"
#include "test/planning/wall_cell.h"

namespace armloom {
namespace {

using testing::WallCell;

// The left arm rests at the goal of the right arm.
struct Middle {
  Middle() {
    Eigen::VectorXd stands(7), reaches(7);
    stands << 0.0, -0.4, 0.0, -2.3, 0.0, 1.9, 0.785;
    reaches << 0.0, 0.4, 0.0, -1.5, 0.0, 1.9, 0.785;
    at = wall.standing(stands);
    const auto& joints = wall.cell->arm(right).joints;
    motion = *joint_line(*wall.cell, joints, wall.cell->arm(right).home, reaches);
  }
  [[nodiscard]] bool lets_pass(const Eigen::VectorXd& q) const {
    Configuration rest = at;
    set_joints(rest, wall.cell->arm(wall.left).joints, q);
    MotionChecker checker(wall.scene);
    return checker
               .judge({.version = 0,
                       .start_at = TimePoint{},
                       .candidates = {{StepId{JobId{0}}, motion, Duration{}}},
                       .others = {},
                       .rest = rest,
                       .method = Swept{TrackingErrors(*wall.cell)}})
               .kind == Verdict::Kind::free;
  }
  WallCell wall;
  ArmId right{1};
  Configuration at;
  TrajectoryPtr motion;
};

TEST(ClearPlaces, AreFreeAndSortedByDistance) {
  const Middle middle;
  const auto& arm = middle.wall.cell->arm(middle.wall.left);
  const Eigen::VectorXd stands = joints_of(middle.at, arm.joints);
  ASSERT_FALSE(middle.lets_pass(stands));
  const auto places =
      places_clear_of(middle.wall.scene, {middle.wall.left, middle.motion}, middle.at);
  ASSERT_TRUE(places) << places.error().detail;
  ASSERT_FALSE(places->q.empty());
  EXPECT_GT(places->evaluations, 0U);
  double last = 0.0;
  for (const Eigen::VectorXd& q : places->q) {
    EXPECT_TRUE(middle.lets_pass(q)) << q.transpose();
    EXPECT_GE((q - stands).norm(), last);
    last = (q - stands).norm();
  }
}

TEST(ClearPlaces, PlanEndsAtOneOfThem) {
  const Middle middle;
  const PlanQuestion question{.goal = {.arm = middle.wall.left, .to = ClearOf{middle.motion}},
                              .at = middle.at};
  const PlanAnswer plan = answer_plan(middle.wall.scene, question);
  ASSERT_TRUE(plan) << plan.error().detail;
  EXPECT_TRUE(middle.lets_pass(plan->way.points.back()));
  EXPECT_EQ(answer_plan(middle.wall.scene, question)->way.points, plan->way.points);
}

}  // namespace
}  // namespace armloom

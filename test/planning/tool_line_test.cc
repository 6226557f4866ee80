#include "core/planning/tool_line.h"

#include <gtest/gtest.h>

#include <random>

#include "core/collision/check/motion_checker.h"
#include "core/planning/answer_plan.h"
#include "core/trajectory/set_joints.h"
#include "test/planning/wall_cell.h"

namespace armloom::testing {
namespace {

class ToolLines : public ::testing::Test {
 protected:
  [[nodiscard]] LinkId link(const char* name) const { return *world.cell->find_link(name); }
  [[nodiscard]] Eigen::Isometry3d pose(const Configuration& q, LinkId of) const {
    LinkPoses X_WL;
    forward_kinematics(*world.cell, q, X_WL);
    return X_WL[of.index()];
  }
  [[nodiscard]] Configuration standing(const Eigen::VectorXd& q) const { return world.standing(q); }
  [[nodiscard]] PlanAnswer go(const Configuration& at, const Eigen::Isometry3d& X_WL,
                              const char* of = "left_panda_link8") const {
    const MotionGoal goal{
        .arm = world.left, .to = LinkTarget{link(of), X_WL}, .speed = 1.0, .straight = true};
    return answer_plan(world.scene, {.goal = goal, .at = at});
  }
  // Checks every 0.5 ms, independently of the planner.
  void expect_on_line(const Configuration& at, const Eigen::Isometry3d& to,
                      const Trajectory& motion) const {
    const LinkId of = link("left_panda_link8");
    const Eigen::Isometry3d from = pose(at, of);
    const Eigen::Vector3d way = to.translation() - from.translation();
    const Eigen::AngleAxisd turn(from.linear().transpose() * to.linear());
    Configuration q = at;
    Eigen::VectorXd joints;
    for (Duration t{}; t <= motion.duration(); t += std::chrono::microseconds(500)) {
      motion.sample_positions(t, joints);
      set_joints(q, motion, joints);
      const Eigen::Isometry3d here = pose(q, of);
      const double share = std::clamp(
          way.dot(here.translation() - from.translation()) / way.squaredNorm(), 0.0, 1.0);
      const Eigen::Vector3d on_line = from.translation() + share * way;
      ASSERT_LE((here.translation() - on_line).norm(), kLineWithin_m) << to_seconds(t);
      const Eigen::AngleAxisd part(share * turn.angle(), turn.axis());
      const Eigen::Matrix3d off =
          (from.linear() * part.toRotationMatrix()).transpose() * here.linear();
      ASSERT_LE(Eigen::AngleAxisd(off).angle(), kLineWithin_rad) << to_seconds(t);
    }
    EXPECT_LE((pose(q, of).translation() - to.translation()).norm(), 2e-3);
    set_joints(q, motion, motion.goal());
    EXPECT_LE((pose(q, of).translation() - to.translation()).norm(), kPoseWithin_m);
    EXPECT_LE(Eigen::AngleAxisd(pose(q, of).linear().transpose() * to.linear()).angle(), 1e-3);
  }
  WallCell world;
};

TEST_F(ToolLines, LinkStaysOnTheLineAtEveryInstant) {
  const Configuration at = standing(world.home());
  Eigen::Isometry3d to = pose(at, link("left_panda_link8"));
  to.translation() += Eigen::Vector3d(0.05, -0.1, 0.1);
  const auto plan = go(at, to);
  ASSERT_TRUE(plan) << plan.error().detail;
  expect_on_line(at, to, *plan->timed.trajectory);
}

TEST_F(ToolLines, LinkRotatesEvenlyAlongTheLine) {
  const Configuration at = standing(world.home());
  Eigen::Isometry3d to = pose(at, link("left_panda_link8"));
  to.translation() += Eigen::Vector3d(0.0, -0.15, 0.0);
  to.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  const auto plan = go(at, to);
  ASSERT_TRUE(plan) << plan.error().detail;
  expect_on_line(at, to, *plan->timed.trajectory);
}

TEST_F(ToolLines, RandomLinesAreKeptOrRejectedWithThePlace) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int kept = 0, broken = 0;
  for (int i = 0; i < 60; ++i) {
    Eigen::VectorXd q = world.home();
    for (Eigen::Index j = 0; j < q.size(); ++j) q[j] += 0.3 * unit(random);
    const Configuration at = standing(q);
    Eigen::Isometry3d to = pose(at, link("left_panda_link8"));
    to.translation() += 0.3 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    to.rotate(Eigen::AngleAxisd(0.5 * unit(random), Eigen::Vector3d::UnitX()));
    const auto plan = go(at, to);
    if (plan) {
      ++kept;
      expect_on_line(at, to, *plan->timed.trajectory);
      if (HasFatalFailure()) return;
    } else {
      ++broken;
      EXPECT_NE(plan.error().detail.find("of the straight line"), std::string::npos)
          << plan.error().detail;
    }
  }
  EXPECT_GE(kept, 15) << "kept";
  EXPECT_GE(broken, 1) << "broken";
}

TEST_F(ToolLines, LineBeyondTheReachReportsHowFarItGoes) {
  const Configuration at = standing(world.home());
  Eigen::Isometry3d to = pose(at, link("left_panda_link8"));
  to.translation().z() += 1.5;
  const auto plan = go(at, to);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().reason, PlanRefusal::Reason::line_broken);
  EXPECT_EQ(reason_name(plan.error().reason), "line-broken");
  EXPECT_NE(plan.error().detail.find("of 1.500 m of the straight line"), std::string::npos)
      << plan.error().detail;
}

TEST_F(ToolLines, LineThroughAnObjectReportsObjectAndPlace) {
  const Configuration at = standing(WallCell::reach(1.2));
  const LinkId of = link("left_panda_link8");
  const Eigen::Isometry3d to = pose(standing(WallCell::reach(1.9)), of);
  const auto plan = go(at, to);
  ASSERT_FALSE(plan);
  if (plan.error().reason == PlanRefusal::Reason::line_blocked) {
    ASSERT_TRUE(plan.error().proximity);
    EXPECT_EQ(plan.error().proximity->body_b, "board");
  }
  EXPECT_NE(plan.error().detail.find("of the straight line"), std::string::npos)
      << plan.error().detail;
}

TEST_F(ToolLines, RejectsALinkThatTheArmDoesNotMove) {
  const Configuration at = standing(world.home());
  const auto plan = go(at, Eigen::Isometry3d::Identity(), "right_panda_link8");
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().reason, PlanRefusal::Reason::goal_not_reached);
}

TEST_F(ToolLines, LineOfZeroLengthIsShort) {
  const Configuration at = standing(world.home());
  const auto plan = go(at, pose(at, link("left_panda_link8")));
  ASSERT_TRUE(plan) << plan.error().detail;
  EXPECT_LT(plan->timed.trajectory->duration(), std::chrono::milliseconds(100));
}

TEST_F(ToolLines, IsDeterministic) {
  const Configuration at = standing(world.home());
  Eigen::Isometry3d to = pose(at, link("left_panda_link8"));
  to.translation().y() -= 0.1;
  const auto once = go(at, to), twice = go(at, to);
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(once->way.points, twice->way.points);
}

}  // namespace
}  // namespace armloom::testing

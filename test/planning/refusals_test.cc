#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/collision/check/line_checker.h"
#include "core/planning/answer_plan.h"
#include "core/planning/plan_goal.h"
#include "test/planning/wall_cell.h"

namespace armloom::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Reason = PlanRefusal::Reason;

class Refusals : public ::testing::Test {
 protected:
  [[nodiscard]] PlanRefusal refusal(MotionGoal goal, const Configuration& at) const {
    const auto answer = answer_plan(wall.scene, {.goal = std::move(goal), .at = at});
    if (answer) throw std::logic_error("there is a plan");
    return answer.error();
  }
  [[nodiscard]] PlanRefusal refusal(const Eigen::VectorXd& to) const {
    return refusal({.arm = wall.left, .to = to}, wall.cell->home());
  }
  [[nodiscard]] bool is_free(const Eigen::VectorXd& q) const {
    LineChecker lines(wall.scene, wall.left, wall.cell->home(),
                      wall.cell->checking.tracking_error_rad);
    return lines.is_free(q, q);
  }
  [[nodiscard]] Eigen::VectorXd in_the_table() const {
    Eigen::VectorXd q = wall.before();
    q[1] = 1.7;
    return q;
  }
  [[nodiscard]] MotionGoal line_from(const Configuration& at, const Eigen::Vector3d& goes) const {
    const LinkId link = *wall.cell->find_link("left_panda_link8");
    LinkPoses X_WL;
    forward_kinematics(*wall.cell, at, X_WL);
    Eigen::Isometry3d to = X_WL[link.index()];
    to.translation() += goes;
    return {.arm = wall.left, .to = LinkTarget{link, to}, .speed = 1.0, .straight = true};
  }
  WallCell wall;
};

// FCL aborted the process for unlimited continuous joints.
TEST(RefusalsOfContinuousJoints, GoalTooFarIsReportedWithItsLimit) {
  const CellPtr cell = build_or_fail(two_arms_description());
  const PlanningScenePtr scene = *PlanningScene::build(cell);
  const ArmId arm = *cell->joint(*cell->find_joint("t_r_spin")).arm;
  for (const double far : {-1e300, -1e154, 2e5, 1e17, 1e30, 1e300}) {
    Eigen::VectorXd to = cell->arm(arm).home;
    to[0] = far;
    const auto answer = answer_plan(scene, {.goal = {.arm = arm, .to = to}, .at = cell->home()});
    ASSERT_FALSE(answer) << far;
    EXPECT_EQ(answer.error().reason, Reason::outside_limits) << far;
    EXPECT_THAT(answer.error().detail, HasSubstr("t_r_spin")) << far;
    ASSERT_TRUE(answer.error().outside);
    EXPECT_EQ(answer.error().outside->position, far);
  }
}

TEST_F(Refusals, GoalInCollisionSuggestsTheNearestFreeGoal) {
  const Eigen::VectorXd wanted = in_the_table();
  const PlanRefusal why = refusal(wanted);
  EXPECT_EQ(why.reason, Reason::goal_in_collision);
  EXPECT_FALSE(why.is_of_start());
  ASSERT_TRUE(why.nearest);
  EXPECT_TRUE(is_free(*why.nearest));
  // The suggestion is at the edge.
  EXPECT_FALSE(is_free(*why.nearest + 0.01 * (wanted - *why.nearest)));
  EXPECT_LT((*why.nearest - wanted).norm(), 1.0);
  EXPECT_LE((why.nearest->array() != wanted.array()).count(), 3) << "by few joints";
  EXPECT_TRUE(answer_plan(
      wall.scene, {.goal = {.arm = wall.left, .to = *why.nearest}, .at = wall.cell->home()}));
}

TEST_F(Refusals, GoalOutsideLimitsReportsTheJointAndTheNearestGoal) {
  Eigen::VectorXd wanted = wall.before();
  wanted[3] = 0.5;
  const PlanRefusal why = refusal(wanted);
  EXPECT_EQ(why.reason, Reason::outside_limits);
  ASSERT_TRUE(why.outside);
  EXPECT_FALSE(why.outside->at_start);
  EXPECT_EQ(why.outside->joint, 3U);
  EXPECT_EQ(why.outside->position, 0.5);
  ASSERT_TRUE(why.nearest);
  EXPECT_TRUE(is_free(*why.nearest));
  EXPECT_LE((*why.nearest)[3], wall.cell->joint(wall.cell->arm(wall.left).joints[3]).upper);
}

TEST_F(Refusals, StartInCollisionSuggestsTheNearestFreeState) {
  const PlanRefusal why =
      refusal({.arm = wall.left, .to = wall.before()}, wall.standing(in_the_table()));
  EXPECT_EQ(why.reason, Reason::start_in_collision);
  EXPECT_TRUE(why.is_of_start());
  ASSERT_TRUE(why.nearest);
  EXPECT_TRUE(is_free(*why.nearest));
}

TEST_F(Refusals, BlockedLineReportsTheClearanceAndHowFarItIsFree) {
  const Configuration at = wall.standing(WallCell::reach(0.9));
  const PlanRefusal why = refusal(line_from(at, {-0.3, 0.1, 0.0}), at);
  ASSERT_EQ(why.reason, Reason::line_blocked) << why.detail;
  ASSERT_TRUE(why.proximity);
  EXPECT_EQ(why.proximity->limit_m, wall.cell->clearances.clearance_m);
  EXPECT_THAT(why.detail, HasSubstr("20 mm are required"));
  ASSERT_TRUE(why.nearest);
  EXPECT_TRUE(is_free(*why.nearest));
}

TEST_F(Refusals, BrokenLineReportsHowFarItGoes) {
  const Configuration at = wall.standing(wall.home());
  const PlanRefusal why = refusal(line_from(at, {0.0, 0.0, 1.5}), at);
  ASSERT_EQ(why.reason, Reason::line_broken);
  EXPECT_EQ(why.link, "left_panda_link8");
  ASSERT_TRUE(why.nearest);
  LinkPoses X_WL;
  forward_kinematics(*wall.cell, wall.standing(*why.nearest), X_WL);
  const double z_m = X_WL[wall.cell->find_link("left_panda_link8")->index()].translation().z();
  forward_kinematics(*wall.cell, at, X_WL);
  EXPECT_GT(z_m, X_WL[wall.cell->find_link("left_panda_link8")->index()].translation().z());
}

TEST_F(Refusals, MessageStatesTheRequiredClearance) {
  Proximity near{.body_a = "hand", .body_b = "table", .arm_a = wall.left, .arm_b = {}};
  near.limit_m = 0.02;
  near.clearance_m = 0.003;
  EXPECT_EQ(in_words(near), "hand is 3 mm from table; 20 mm are required");
  near.clearance_m = -0.001;
  EXPECT_EQ(in_words(near), "hand overlaps table by 1 mm; 20 mm are required");
  near.clearance_m = 0.0;
  EXPECT_EQ(in_words(near), "hand touches table; 20 mm are required");
  near.clearance_m = 0.0205;
  EXPECT_EQ(in_words(near, 0.0012),
            "hand is 20.5 mm from table; 20 mm are required, plus 1.2 mm for the tracking error");
  EXPECT_THAT(in_words(near), HasSubstr("20 mm are required, which could not be certified"));
  near.limit_m = 0.0;
  near.clearance_m = 0.0;
  EXPECT_THAT(in_words(near), Not(HasSubstr("0 mm are required")));
}

// The closest pair may be two links of the arm itself, which are close by design.
TEST_F(Refusals, ReportsThePairTooCloseForTheTrackingError) {
  Eigen::VectorXd q = wall.before();
  LineChecker lines(wall.scene, wall.left, wall.cell->home(),
                    wall.cell->checking.tracking_error_rad);
  int seen = 0;
  for (q[1] = 0.2; q[1] < 1.7; q[1] += 1e-4) {
    const auto answer = lines.state(q);
    const bool is_free = answer.kind == LineChecker::Kind::free;
    if (is_free || answer.proximity->clearance_m < answer.proximity->limit_m) continue;
    ++seen;
    EXPECT_GT(answer.moves_m, 0.0);
    EXPECT_LT(answer.proximity->clearance_m, answer.proximity->limit_m + answer.moves_m);
  }
  EXPECT_GE(seen, 1) << "no state in between was met";
}

TEST_F(Refusals, WrongLinkIsReportedWithTheLinksOfTheArm) {
  const auto said = [](const char* link) {
    return PlanGoal{.joints = {}, .named = {}, .pose = PlanPose{.link = link}};
  };
  const auto other = goals_of(*wall.cell, {"left", {}}, said("right_panda_link8"), "/move_to");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().front().pointer, "/move_to/pose/link");
  EXPECT_THAT(other.error().front().detail,
              HasSubstr("arm left does not move right_panda_link8; it moves left_panda_link1, "));
  const auto unknown = goals_of(*wall.cell, {"left", {}}, said("panda_link9"), "/move_to");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().front().pointer, "/move_to/pose/link");
  EXPECT_THAT(unknown.error().front().detail, HasSubstr("did you mean panda_link"));
  const auto nobody = goals_of(*wall.cell, {}, said("panda_link8"), "/move_to");
  ASSERT_FALSE(nobody);
  EXPECT_EQ(nobody.error().front().pointer, "/arm");
  EXPECT_THAT(nobody.error().front().detail, HasSubstr("the cell has left, right"));
}

}  // namespace
}  // namespace armloom::testing

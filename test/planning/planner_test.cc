#include "core/planning/planner.h"

#include <gtest/gtest.h>

#include <atomic>

#include "core/audit/audit.h"
#include "core/collision/check/line_checker.h"
#include "core/planning/plan_motion.h"
#include "test/collision/rails.h"
#include "test/planning/wall_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Reason = PlanRefusal::Reason;
using testing::WallCell;

PlanRequest around_the_board(const WallCell& wall) {
  return {.arm = wall.left, .at = wall.standing(wall.before()), .goals = {wall.behind()}};
}

TEST(Planner, UsesTheStraightLineIfFree) {
  const WallCell wall;
  const auto way = Planner(wall.scene)
                       .plan({.arm = wall.left, .at = wall.cell->home(), .goals = {wall.before()}});
  ASSERT_TRUE(way) << way.error().detail;
  EXPECT_EQ(way->points, (std::vector<Eigen::VectorXd>{wall.home(), wall.before()}));
}

TEST(Planner, FindsACertifiedPathAroundAnObstacle) {
  const WallCell wall;
  const PlanRequest request = around_the_board(wall);
  LineChecker lines(wall.scene, wall.left, request.at, wall.cell->checking.tracking_error_rad);
  ASSERT_FALSE(lines.is_free(wall.before(), wall.behind())) << "the board is in the way";
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PlanRequest seeded = request;
    seeded.seed = seed;
    const auto way = Planner(wall.scene).plan(seeded);
    ASSERT_TRUE(way) << way.error().detail;
    EXPECT_EQ(way->points.front(), wall.before());
    EXPECT_EQ(way->points.back(), wall.behind());
    EXPECT_GT(way->points.size(), 2u);
    for (std::size_t i = 0; i + 1 < way->points.size(); ++i) {
      EXPECT_TRUE(lines.is_free(way->points[i], way->points[i + 1])) << i;
    }
    EXPECT_LE(way->length(), 4.0 * (wall.behind() - wall.before()).norm());
  }
}

TEST(Planner, IsDeterministicForASeed) {
  const WallCell wall;
  PlanRequest request = around_the_board(wall);
  const Planner planner(wall.scene);
  const auto first = planner.plan(request);
  ASSERT_TRUE(first);
  EXPECT_EQ(planner.plan(request)->points, first->points);
  EXPECT_EQ(Planner(wall.scene).plan(request)->evaluations, first->evaluations);
  bool differs = false;
  for (request.seed = 2; request.seed < 6; ++request.seed) {
    differs = differs || planner.plan(request)->points != first->points;
  }
  EXPECT_TRUE(differs);
}

TEST(Planner, ChoosesTheNearestReachableGoal) {
  const WallCell wall;
  Eigen::VectorXd in_the_table = wall.before();
  in_the_table[1] = 1.7;
  const auto way = Planner(wall.scene)
                       .plan({.arm = wall.left,
                              .at = wall.cell->home(),
                              .goals = {in_the_table, wall.behind(), wall.before()}});
  ASSERT_TRUE(way);
  EXPECT_EQ(way->goal, 2u);
}

// An arm that rests too close to another one can be moved away. It may not end there.
TEST(Planner, LeavesAnArmThatIsTooClose) {
  rails::Rails rails;
  const auto at = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  const PlanningScenePtr scene = *PlanningScene::build(rails.cell);
  rails.question.rest[1] = 0.0;  // y, on x's rail
  for (const double gap_m : {rails::kApart_m + rails::kTracking_m, rails::kApart_m - 0.01}) {
    PlanRequest request{.arm = rails::kX, .at = rails.question.rest, .goals = {at(-1.0)}};
    request.at[0] = -gap_m;
    const auto way = Planner(scene).plan(request);
    ASSERT_TRUE(way) << way.error().detail;
    EXPECT_EQ(way->points.size(), 2u);
    request.goals = {at(-rails::kApart_m - 0.0005)};
    EXPECT_EQ(Planner(scene).plan(request).error().reason, Reason::goal_in_collision);
  }
}

TEST(Planner, ReportsWhyThereIsNoPlan) {
  const WallCell wall;
  const Planner planner(wall.scene);
  PlanRequest request{.arm = wall.left, .at = wall.cell->home(), .goals = {wall.before()}};

  Eigen::VectorXd in_the_table = wall.before();
  in_the_table[1] = 1.7;
  request.goals = {in_the_table};
  auto refusal = planner.plan(request).error();
  EXPECT_EQ(refusal.reason, Reason::goal_in_collision);
  ASSERT_TRUE(refusal.proximity);
  EXPECT_NE(refusal.detail.find(refusal.proximity->body_b), std::string::npos) << refusal.detail;

  request.at = wall.standing(in_the_table);
  refusal = planner.plan(request).error();
  EXPECT_EQ(refusal.reason, Reason::start_in_collision);

  request.at = wall.cell->home();
  request.goals[0][3] = 0.5;
  refusal = planner.plan(request).error();
  EXPECT_EQ(refusal.reason, Reason::outside_limits);
  EXPECT_NE(refusal.detail.find("left_panda_joint4"), std::string::npos) << refusal.detail;

  request = around_the_board(wall);
  request.budget = 30;
  refusal = planner.plan(request).error();
  EXPECT_EQ(refusal.reason, Reason::not_found);
  EXPECT_LE(refusal.evaluations, 30u + 2u * 3000u) << "a line or two more at most";

  const std::atomic<bool> cancelled = true;
  request = around_the_board(wall);
  request.cancelled = &cancelled;
  EXPECT_EQ(planner.plan(request).error().reason, Reason::cancelled);
}

// An arm with one joint has one path only.
TEST(Planner, NamesWhatBlocksTheOnlyPath) {
  rails::Rails rails;
  rails.question.rest[1] = 0.0;  // y, on x's rail
  const auto at = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  PlanRequest request{.arm = rails::kX, .at = rails.question.rest, .goals = {at(-1.0)}};
  const PlanRefusal refusal = Planner(*PlanningScene::build(rails.cell)).plan(request).error();
  EXPECT_EQ(refusal.reason, Reason::not_found) << refusal.detail;
  EXPECT_LT(refusal.evaluations, 1000U);
  ASSERT_TRUE(refusal.proximity);
  EXPECT_EQ(refusal.proximity->arm_b, rails::kY);
}

// A controller may report an arm at its limit a little beyond it.
TEST(Planner, BeginsInsideTheLimits) {
  rails::Rails rails;
  const auto at = [](double x) { return Eigen::VectorXd::Constant(1, x); };
  const PlanningScenePtr scene = *PlanningScene::build(rails.cell);
  PlanRequest request{.arm = rails::kX, .at = rails.question.rest, .goals = {at(1.0)}};
  request.at[0] = 2.0 + rails.cell->execution.start_tolerance_rad - 1e-6;
  const auto way = Planner(scene).plan(request);
  ASSERT_TRUE(way) << way.error().detail;
  EXPECT_EQ(way->points.front(), at(2.0));
  request.at[0] += 1e-5;
  EXPECT_EQ(Planner(scene).plan(request).error().reason, Reason::outside_limits);
}

// With few joints, comparing the many nodes with each other takes longer than evaluating states.
TEST(Planner, CountsNodeComparisonsInItsBudget) {
  rails::Rails rails;
  Cell made = *rails.cell;
  const ArmId turns = small::add_robot(made, "turns", small::at_xyz(0, 0, 0),
                                       {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX()},
                                       {0.0, rails::kRadius_m});
  made.joints.back().kind = made.links.back().motion = JointKind::prismatic;
  made.joints.back().lower = -2.0;
  made.joints.back().upper = 2.0;
  made.links[made.links.size() - 2].shapes.clear();
  const CellPtr cell = small::shared(std::move(made));
  Configuration rest = cell->home();
  rest[0] = 1.9, rest[1] = 0.0;  // y, on the new arm's line
  rest[static_cast<Eigen::Index>(cell->arm(turns).joints[1].index())] = 0.5;
  PlanRequest request{.arm = turns, .at = rest, .goals = {Eigen::Vector2d(0.0, -1.0)}};
  const PlanRefusal refusal = Planner(*PlanningScene::build(cell)).plan(request).error();
  EXPECT_EQ(refusal.reason, Reason::not_found) << refusal.detail;
  EXPECT_LT(refusal.evaluations, 350'000U);
}

TEST(Planner, ThrowsOnSizeMismatch) {
  const WallCell wall;
  PlanRequest request{.arm = wall.left, .at = wall.cell->home(), .goals = {}};
  EXPECT_THROW((void)Planner(wall.scene).plan(request), std::invalid_argument);
  request.goals = {Eigen::VectorXd::Zero(3)};
  EXPECT_THROW((void)Planner(wall.scene).plan(request), std::invalid_argument);
}

TEST(PlanMotion, KeepsTheClearanceAccordingToTheAudit) {
  const WallCell wall;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    PlanRequest request = around_the_board(wall);
    request.seed = seed;
    const auto planned = plan_motion(Planner(wall.scene), request);
    ASSERT_TRUE(planned) << planned.error().detail;
    const Trajectory& motion = *planned->timed.trajectory;
    EXPECT_EQ(motion.start(), wall.before());
    EXPECT_LE((motion.goal() - wall.behind()).norm(), 1e-12);
    std::vector<RecordedState> states;
    Eigen::VectorXd q;
    for (Duration t{}; t <= motion.duration(); t += 5ms) {
      motion.sample_positions(t, q);
      states.push_back({at(t), wall.standing(q)});
    }
    const auto report = audit(*wall.cell, states, 1ms);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->first_contact);
    EXPECT_GE(report->smallest_clearance->distance_m, wall.cell->clearances.clearance_m - 1e-6);
  }
}

TEST(PlanMotion, ToTheCurrentPositionIsAShortMotion) {
  const WallCell wall;
  const auto planned = plan_motion(
      Planner(wall.scene), {.arm = wall.left, .at = wall.cell->home(), .goals = {wall.home()}});
  ASSERT_TRUE(planned) << planned.error().detail;
  EXPECT_EQ(planned->timed.trajectory->duration(), 10ms);
}

}  // namespace
}  // namespace armloom

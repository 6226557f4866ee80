// A failed planning query is repeated only if something that it depends on has changed.
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

// Adds walls around the goal.
void shut_in(TwoGantries& cell, Place_m goal) {
  int side = 0;
  for (const auto& [x, y, width, depth] :
       {std::array{0.4, 0.0, 0.05, 0.85}, std::array{-0.4, 0.0, 0.05, 0.85},
        std::array{0.0, 0.4, 0.85, 0.05}, std::array{0.0, -0.4, 0.85, 0.05}}) {
    CollisionObject wall{.name = "wall " + std::to_string(side++),
                         .shape = Box{{width, depth, 0.5}}};
    wall.X_WO.translation() = Eigen::Vector3d(goal.first + x, goal.second + y, 0.0);
    ASSERT_TRUE(cell.executive().scene().add(std::move(wall)));
  }
}

class FailedPlans : public ::testing::Test {
 protected:
  FailedPlans() : cell(gantries(OnIdleBlocker::report), "earliest_start") {}
  // Submits a goal that must fail; returns the number of state checks of its planning.
  std::uint64_t fails(const std::string& key) {
    const std::uint64_t before = cell.planning().evaluations;
    cell.submit(to_place("a", {-1, 2}, key));
    cell.run_to_the_end(cell.executive().now() + 50s);
    EXPECT_EQ(cell.job(key).reason(), Reason::no_plan) << key;
    return cell.planning().evaluations - before;
  }
  TwoGantries cell;
};

TEST_F(FailedPlans, CostNothingTheSecondTime) {
  shut_in(cell, {-1, 2});
  EXPECT_GT(fails("first"), 100'000U);
  const std::string why = cell.job("first").detail();
  EXPECT_EQ(fails("second"), 0U);
  EXPECT_EQ(cell.job("second").detail(), why);
}

TEST_F(FailedPlans, CostNothingIfOnlyAnIgnoredArmMoved) {
  shut_in(cell, {-1, 2});
  EXPECT_GT(fails("first"), 100'000U);
  cell.submit(go("b", {1, 0}, {1, 1}, 3, "b"));
  cell.run_to_the_end(cell.executive().now() + 50s);
  EXPECT_EQ(fails("second"), 0U);
}

TEST_F(FailedPlans, AreRetriedFromANewStartOrInANewScene) {
  shut_in(cell, {-1, 2});
  EXPECT_GT(fails("first"), 100'000U);
  cell.submit(go("a", {-1, 0}, {-1, 0.2}, 3, "elsewhere"));
  cell.run_to_the_end(cell.executive().now() + 50s);
  EXPECT_GT(fails("from there"), 100'000U);
  EXPECT_EQ(fails("again"), 0U);
  for (int side = 0; side < 4; ++side) {
    ASSERT_TRUE(cell.executive().scene().remove("wall " + std::to_string(side)));
  }
  cell.submit(to_place("a", {-1, 2}, "open"));
  cell.run_to_the_end(cell.executive().now() + 50s);
  EXPECT_EQ(cell.job("open").state, JobState::succeeded) << cell.job("open").detail();
}

TEST_F(FailedPlans, ReplanOfAGoalIsPlannedOnce) {
  cell.submit(to_place("a", {-1, 3}, "goal"));
  cell.run_until(at(1s));
  ASSERT_EQ(cell.job("goal").state, JobState::running);
  ASSERT_EQ(cell.planning().plans, 1U);
  ASSERT_TRUE(cell.executive().replan("goal"));
  cell.run_to_the_end();
  EXPECT_EQ(cell.job("goal").state, JobState::succeeded);
  EXPECT_EQ(cell.job("goal").ways.another_way->done, 1U);
  EXPECT_EQ(cell.planning().plans, 2U);
}

}  // namespace
}  // namespace armloom

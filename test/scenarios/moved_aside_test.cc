// Goals whose way was planned beside an arm that a move aside has taken elsewhere since.
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

class BesideAMovedArm : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, BesideAMovedArm, ::testing::ValuesIn(known_policies()));

// b comes to rest in the way of a's first job and is sent back to where it came from: onto the
// straight way to a's goal, which was planned while b was to stand elsewhere.
TEST_P(BesideAMovedArm, AGoalIsPlannedAnewAndReached) {
  TwoGantries cell(gantries(OnIdleBlocker::park), GetParam());
  cell.submit(go("b", {1, 0}, {0, 0}, 3.0, "in the way"));
  cell.run_until(at(100ms));
  cell.submit(go("a", {-1, 0}, {0.6, 0}, 3.0, "past it"));
  JobRequest goal{.key = "goal", .name = "", .trajectory = {}};
  goal.arm = "a";
  goal.move_to = PlanGoal{.joints = std::vector{1.4, 0.0}, .named = {}, .pose = {}};
  cell.submit(goal);
  cell.run_to_the_end(at(200s));
  EXPECT_EQ(cell.job("past it").state, JobState::succeeded) << cell.job("past it").detail();
  EXPECT_EQ(cell.job("goal").state, JobState::succeeded) << cell.job("goal").detail();
  cell.expect_at("a", {1.4, 0.0});
  EXPECT_GT(cell.farthest_off_m(), 0.1) << "around b";
  EXPECT_GT(cell.closest_m(), 0.0);
}

}  // namespace
}  // namespace armloom

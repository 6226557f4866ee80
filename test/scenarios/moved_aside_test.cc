#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

class AfterARetreat : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, AfterARetreat, ::testing::ValuesIn(known_policies()));

// b rests in the way of a's first job and retreats: onto the straight path to a's goal. That path
// was planned while b was expected elsewhere.
TEST_P(AfterARetreat, GoalIsReplannedAndReached) {
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

// b's goal is where a is, and a must go past b. a's path was planned around b's expected end, so it
// leads through b's present place.
TEST_P(AfterARetreat, BlockedGoalsAreNoDeadlockIfADetourExists) {
  TwoGantries cell(gantries(OnIdleBlocker::report), GetParam());
  cell.submit(to_place("b", {-1, 0}, "to its place"));
  cell.submit(to_place("a", {1.4, 0}, "past it"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"past it", "to its place"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << cell.job(key).detail();
  }
  EXPECT_GT(cell.closest_m(), 0.0);
}

// While c's goal is being planned, b overtakes c and comes to rest on c's path. Another arm could
// then take the place that c must leave again, and would stay there.
TEST_P(AfterARetreat, OvertakenGoalIsReplannedBeforeOthersBlockIt) {
  TwoGantries cell(
      gantries(OnIdleBlocker::report, {{-0.7, -0.28}, {0.7, 0.28}, {-0.7, 0.28}, {0.7, -0.28}}),
      GetParam());
  cell.submit(to_place("b", {0.42, 0.28}, "b comes"));
  cell.submit(to_place("a", {0.14, -0.28}, "a comes"));
  cell.run_until(at(1700ms));
  cell.submit(to_place("c", {0.42, -0.28}, "c comes"));
  JobRequest overtakes = go("b", {0.42, 0.28}, {-0.14, 0.28}, 2.64, "overtakes");
  overtakes.trajectory.points.push_back({{-0.42, -0.28}, {0.0, 0.0}, {0.0, 0.0}, 5.28});
  cell.submit(overtakes);
  cell.submit(to_place("c", {-0.7, -0.28}, "c leaves"));
  cell.run_until(at(2141ms));
  cell.submit(to_place("a", {0.42, -0.28}, "a follows"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"c comes", "overtakes", "c leaves", "a follows"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key << ": " << cell.job(key).detail();
  }
}

// b rests at c's goal, and a rests in b's straight path for good. b must leave before c arrives.
// Even so, b's path must not be planned through a.
TEST_P(AfterARetreat, PlanAvoidsAnArmThatNeverMoves) {
  TwoGantries cell(gantries(OnIdleBlocker::report, {{0.14, 0.28}, {0.7, 0.28}, {-0.42, -0.28}}),
                   GetParam());
  cell.submit(to_place("c", {0.7, 0.28}, "comes"));
  cell.submit(to_place("b", {-0.7, 0.28}, "goes"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"comes", "goes"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key << ": " << cell.job(key).detail();
  }
}

// d's goal waits while one arm after the other enters and leaves d's path. Planning once failed
// five times with the same arm positions, before the first arm had moved.
TEST_P(AfterARetreat, GoalIsReplannedForEachArmInItsWay) {
  TwoGantries cell(
      gantries(OnIdleBlocker::report, {{-0.42, 0.28}, {0.42, -0.28}, {0.14, 0.28}, {0.14, -0.28}}),
      GetParam());
  cell.submit(go("a", {-0.42, 0.28}, {0.14, 0}, 3.96, "a comes"));
  cell.submit(to_place("b", {-0.42, -0.28}, "b goes"));
  cell.submit(to_place("c", {0.42, 0}, "c goes"));
  cell.submit(to_place("b", {-0.42, 0.28}, "b goes on"));
  cell.run_until(at(1147ms));
  cell.submit(to_place("c", {-0.14, 0}, "c comes"));
  cell.run_until(at(1884ms));
  cell.submit(go("a", {0.14, 0}, {0.7, 0.28}, 3.96, "a leaves"));
  cell.run_until(at(2023ms));
  cell.submit(to_place("d", {-0.14, 0.28}, "goal"));
  cell.run_until(at(2858ms));
  JobRequest last = to_place("a", {0.42, 0.28}, "a comes back");
  last.after = {"c comes"};
  cell.submit(last);
  cell.run_to_the_end(at(200s));
  EXPECT_EQ(cell.job("goal").state, JobState::succeeded) << cell.job("goal").detail();
  EXPECT_EQ(cell.job("a comes back").state, JobState::succeeded)
      << cell.job("a comes back").detail();
}

TEST_P(AfterARetreat, GoalSwapTakesOneRetreat) {
  TwoGantries cell(gantries(OnIdleBlocker::park), GetParam());
  cell.submit(to_place("a", {-0.3, 0.0}, "a comes"));
  cell.submit(to_place("b", {0.4, 0.6}, "b comes"));
  cell.run_to_the_end(at(100s));
  cell.submit(to_place("a", {0.4, 0.6}, "a"));
  cell.submit(to_place("b", {-0.3, 0.0}, "b"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"a", "b"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << cell.job(key).detail();
  }
  cell.expect_at("a", {0.4, 0.6});
  cell.expect_at("b", {-0.3, 0.0});
  EXPECT_TRUE(cell.executive().job("retreat-1"));
  EXPECT_FALSE(cell.executive().job("retreat-2"));
}

// Two rows of three places between walls. When a's goal is planned, b and c block both paths to it,
// and c is about to leave. Once the plan led through b and was kept after c had left.
TEST(AfterADeparture, GoalWithoutAPathIsReplanned) {
  CellDescription description =
      gantries(OnIdleBlocker::report, {{-0.4, -0.4}, {0.12, -0.14}, {-0.14, -0.4}});
  for (RobotDescription& robot : description.robots) {
    for (const char* joint : {"x", "y"}) {
      robot.arms.front().limits[joint].velocity = 0.5;
      robot.arms.front().limits[joint].acceleration = 2.0;
    }
  }
  put_walls(description, {-0.66, 0.38, -0.66, 0.12});
  TwoGantries cell(description, "coordinated");
  cell.submit(to_place("b", {-0.4, -0.14}, "b comes"));
  JobRequest up = go("c", {-0.14, -0.4}, {-0.14, -0.14}, 1.0, "c up");
  up.after = {"b comes"};
  cell.submit(up);
  cell.submit(to_place("c", {0.12, -0.14}, "c leaves"));
  cell.submit(to_place("a", {-0.14, -0.14}, "goal"));
  cell.submit(to_place("c", {-0.4, -0.4}, "c behind a"));
  cell.submit(to_place("c", {0.12, -0.14}, "c back"));
  JobRequest leaves = to_place("b", {-0.14, -0.4}, "b leaves");
  leaves.after = {"c back"};
  cell.submit(leaves);
  cell.submit(go("a", {-0.14, -0.14}, {-0.4, -0.14}, 1.0, "a on"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"goal", "c behind a", "c back", "b leaves", "a on"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key << ": " << cell.job(key).detail();
  }
}

// Returns a job along straight segments of half a second each.
JobRequest along(const std::string& arm, const std::vector<Place_m>& places, std::string key) {
  JobRequest request = go(arm, places.at(0), places.at(1), 0.5, std::move(key));
  for (std::size_t i = 2; i < places.size(); ++i) {
    request.trajectory.points.push_back({{places[i].first, places[i].second},
                                         {0.0, 0.0},
                                         {0.0, 0.0},
                                         0.5 * static_cast<double>(i)});
  }
  return request;
}

// Three rows. As long as a has not left, d has no path to its goal. d's plan leads through b's
// place, where b waits for d. That is no deadlock while a and c may open another path.
TEST_P(AfterARetreat, GoalWithoutAPathIsNoDeadlockWhileOthersMayMove) {
  CellDescription description = gantries(
      OnIdleBlocker::report, {{-0.14, 0.16}, {-0.44, 0.16}, {0.16, -0.44}, {-0.14, -0.14}});
  put_walls(description, {-0.74, 0.46, -0.74, 0.46});
  TwoGantries cell(description, GetParam());
  cell.submit(along("a", {{-0.14, 0.16}, {0.16, 0.16}, {0.16, -0.14}}, "a leaves"));
  cell.submit(to_place("d", {-0.14, 0.16}, "d goes there"));
  cell.submit(
      along("b", {{-0.44, 0.16}, {-0.44, -0.14}, {-0.14, -0.14}, {-0.14, -0.44}}, "b where d was"));
  cell.submit(along("b", {{-0.14, -0.44}, {-0.44, -0.44}}, "b on"));
  cell.submit(to_place("c", {-0.14, -0.14}, "c behind b"));
  cell.submit(along("a", {{0.16, -0.14}, {0.16, -0.44}}, "a where c was"));
  cell.run_to_the_end(at(200s));
  for (const char* key :
       {"a leaves", "d goes there", "b where d was", "b on", "c behind b", "a where c was"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key << ": " << cell.job(key).detail();
  }
}

}  // namespace
}  // namespace armloom

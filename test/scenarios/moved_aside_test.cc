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

// One is to come to where the other stands, which is to go past it: beside where that one will be
// it is planned right through where it is.
TEST_P(BesideAMovedArm, TwoGoalsInEachOthersWayAreNoRingWhereOneCanGoRound) {
  TwoGantries cell(gantries(OnIdleBlocker::report), GetParam());
  cell.submit(to_place("b", {-1, 0}, "to its place"));
  cell.submit(to_place("a", {1.4, 0}, "past it"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"past it", "to its place"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << cell.job(key).detail();
  }
  EXPECT_GT(cell.closest_m(), 0.0);
}

// While c's goal is planned b overtakes it, and comes to rest on that way; what comes then to the
// place that c is to leave again would stay there.
TEST_P(BesideAMovedArm, AGoalThatIsOvertakenIsPlannedAnewBeforeOthersAreInItsWay) {
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

// b stands where c is to go, and a in b's straight way for good: that b has to go before c can come
// is no reason to plan it through a.
TEST_P(BesideAMovedArm, WhoNeverMovesIsPassedThoughAnotherHasToGoFirst) {
  TwoGantries cell(gantries(OnIdleBlocker::report, {{0.14, 0.28}, {0.7, 0.28}, {-0.42, -0.28}}),
                   GetParam());
  cell.submit(to_place("c", {0.7, 0.28}, "comes"));
  cell.submit(to_place("b", {-0.7, 0.28}, "goes"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"comes", "goes"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key << ": " << cell.job(key).detail();
  }
}

// d's goal waits while one arm after the other comes to its way and leaves it again. Before it was
// planned five times in vain, beside the same places, before the first of them had moved.
TEST_P(BesideAMovedArm, AGoalIsPlannedPastEachThatComesHoweverManyDo) {
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

// A goal begins wherever its arm stands: nobody goes back for it onto the other one's goal.
TEST_P(BesideAMovedArm, ASwapOfGoalsTakesOneMoveAside) {
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

// Two rows of three places between walls: a finds both ways to its goal shut when it is planned, by
// b and by c, which is about to leave. Its plan led through b, and where c had gone it stayed so:
// with what waits behind it that made a ring, and jobs failed.
TEST(BesideAnArmThatLeaves, AGoalIsPlannedAnewWhereNoWayWasFound) {
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

// By straight ways, half a second each.
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

// Three rows: where a is still to leave, d finds no way to its goal; what was planned leads through
// where b waits for d to go first. That is no ring, as long as what a and c do may open another
// way.
TEST_P(BesideAMovedArm, AGoalWithoutAWayIsInNoRingAsLongAsOthersMayMove) {
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

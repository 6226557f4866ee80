// A server-initiated motion that is no longer needed. b retreated for "x" and must return to the
// start of its own job "y". Then "y" is canceled, and a rests at that place.
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

class ReturnMotions : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    cell.emplace(gantries(OnIdleBlocker::park), GetParam());
    cell->submit(go("b", {1, 0}, {0, 1}, 3, "there"));
    run_while("there", JobState::succeeded, true);
    cell->submit(go("a", {-1, 0}, {0, 1}, 4, "x"));
    cell->submit(go("b", {0, 1}, {-1, 0}, 4, "y"));
    run_while("x", JobState::running, true);
    ASSERT_LT(cell->job("retreat-2").state, JobState::scheduled) << "b is to return";
    ASSERT_TRUE(cell->executive().cancel("y"));
    run_while("x", JobState::running, false);
  }
  void run_while(const std::string& key, JobState state, bool other) {
    while ((cell->job(key).state == state) != other && cell->now() < at(30s)) {
      cell->run_until(cell->now() + 10ms);
    }
  }
  std::optional<TwoGantries> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, ReturnMotions, ::testing::ValuesIn(known_policies()));

TEST_P(ReturnMotions, SucceedIfTheNextJobStartsWhereTheyEnd) {
  cell->submit(go("b", {0, 1}, {1, 1}, 2, "next"));
  cell->run_to_the_end(at(45s));
  EXPECT_EQ(cell->job("next").state, JobState::succeeded) << cell->job("next").detail();
  cell->expect_at("b", {1, 1});
}

TEST_P(ReturnMotions, AreCanceledIfTheNextJobCanStartAnywhere) {
  JobRequest goal{.key = "next", .name = "", .trajectory = {}};
  goal.arm = "b";
  goal.move_to = PlanGoal{.joints = std::vector{1.0, -1.0}, .named = {}, .pose = {}};
  cell->submit(goal);
  cell->run_to_the_end(at(45s));
  EXPECT_EQ(cell->job("next").state, JobState::succeeded) << cell->job("next").detail();
  EXPECT_EQ(cell->job("retreat-2").state, JobState::canceled) << cell->job("retreat-2").detail();
  cell->expect_at("b", {1, -1});
}

}  // namespace
}  // namespace armloom

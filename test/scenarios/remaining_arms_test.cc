#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

class RemainingArms : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, RemainingArms, ::testing::ValuesIn(known_policies()));

// Returns a job that moves to a place and back to its start.
JobRequest visit(const std::string& arm, Place_m from, Place_m to, double duration_s,
                 std::string key) {
  JobRequest request = go(arm, from, to, duration_s / 2, std::move(key));
  request.trajectory.points.push_back(request.trajectory.points.front());
  request.trajectory.points.back().time_from_start_s = duration_s;
  return request;
}

// "either" would finish sooner with a, behind a's other job. But c comes to rest in a's path for
// good, and b leaves for a place from which it cannot start "either". All jobs can be done in the
// order of submission, so b must do "either" before it leaves.
TEST_P(RemainingArms, TakeTheJobBeforeTheyAreBlockedToo) {
  TwoGantries cell(gantries(OnIdleBlocker::report, {{-0.5, 0}, {0.5, 0}, {0, 0.6}}), GetParam());
  JobRequest either = visit("a", {-0.5, 0}, {0, 0}, 4, "either");
  either.alternatives = {either.trajectory, visit("b", {0.5, 0}, {0.5, -0.9}, 7.2, "").trajectory};
  either.trajectory = {};
  JobRequest stays = go("c", {0, 0.6}, {0, 0}, 1.5, "stays");
  stays.terms.priority = 5;
  cell.submit(visit("a", {-0.5, 0}, {-0.5, -0.4}, 2, "visits"));
  cell.submit(std::move(either));
  cell.submit(std::move(stays));
  cell.submit(go("b", {0.5, 0}, {0.3, 0.4}, 1, "leaves"));
  cell.run_to_the_end(at(200s));
  for (const char* key : {"visits", "either", "stays", "leaves"}) {
    EXPECT_EQ(cell.job(key).state, JobState::succeeded) << key << ": " << cell.job(key).detail();
  }
  EXPECT_GT(cell.closest_m(), 0.0);
}

}  // namespace
}  // namespace armloom

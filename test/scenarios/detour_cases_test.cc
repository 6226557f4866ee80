// Goals whose shortest path has to wait for other arms. The arm takes a detour if it arrives sooner
// that way (detour.h).
#include <cmath>
#include <cstdio>
#include <random>

#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

// Returns a job of b, which enters the middle, rests there for stays_s, and leaves sideways.
JobRequest across(double stays_s) {
  JobRequest request = go("b", {1, 0}, {0, 0}, 2.0, "b");
  auto& points = request.trajectory.points;
  const std::vector<double> zero{0.0, 0.0};
  if (stays_s > 0.0) points.push_back({{0, 0}, zero, zero, 2.0 + stays_s});
  points.push_back({{0, -2}, zero, zero, 5.0 + stays_s});
  return request;
}

// Runs under the policies that let an arm pass a place where another arm is at another time.
class Detours : public ::testing::TestWithParam<std::string> {
 protected:
  // Returns the time at which a reaches (0.6, 0) from (-1, 0), past b in the middle.
  double arrives_s(const JobRequest& of_a, double b_stays_s, TimePoint sent = at(1s)) {
    cell.emplace(gantries(OnIdleBlocker::report), GetParam());
    cell->submit(across(b_stays_s));
    cell->run_until(sent);
    cell->submit(of_a);
    cell->run_to_the_end(at(200s));
    const JobView job = cell->job(of_a.key);
    EXPECT_EQ(job.state, JobState::succeeded) << job.detail();
    EXPECT_GT(cell->closest_m(), 0.019);
    cell->expect_at("a", {0.6, 0.0});
    return to_seconds(*job.times.ended_at);
  }
  std::optional<TwoGantries> cell;
};
INSTANTIATE_TEST_SUITE_P(Policies, Detours,
                         ::testing::Values("certified", "earliest_start", "coordinated"));

TEST_P(Detours, AreTakenIfWaitingTakesLonger) {
  EXPECT_LT(arrives_s(to_place("a", {0.6, 0.0}, "a"), 30.0), 20.0);
  EXPECT_GT(cell->farthest_off_m(), 0.2);
  const auto detour = cell->job("a").ways.detour;
  ASSERT_TRUE(detour);
  EXPECT_GE(detour->candidates_evaluated, 1U);
  EXPECT_TRUE(detour->is_selected);
  // A detour saves no time if the shortest path could start now, and none is reported if it could
  // never start.
  const double least_s = GetParam() == "certified" ? 0.0 : 10.0;
  EXPECT_GE(detour->time_saved_s.value_or(0.0), least_s) << "b stays for 30 s";
}

TEST_P(Detours, AreNotTakenIfWaitingIsShort) {
  (void)arrives_s(to_place("a", {0.6, 0.0}, "a"), 0.0, at(2500ms));
  EXPECT_LT(cell->farthest_off_m(), 0.01);
  EXPECT_FALSE(cell->job("a").ways.detour && cell->job("a").ways.detour->is_selected);
}

TEST_P(Detours, AreNotTakenByTrajectories) {
  EXPECT_GT(arrives_s(go("a", {-1, 0}, {0.6, 0}, 3.0, "a"), 30.0), 30.0);
}

TEST_P(Detours, NeedFewPlansForOneBlockedPlace) {
  (void)arrives_s(to_place("a", {0.6, 0.0}, "a"), 30.0);
  EXPECT_LE(cell->planning().plans, 5U) << "its own way, and those around";
}

// Compares the mean arrival of goals with that of the straight paths as trajectories, and prints
// both.
TEST_P(Detours, NeverArriveMuchLaterThanTheStraightPath) {
  std::mt19937_64 random(1);
  double goals_s = 0.0, lines_s = 0.0;
  std::uint64_t evaluations = 0;
  constexpr int kRuns = 20;
  for (int i = 0; i < kRuns; ++i) {
    const double stays_s = std::uniform_real_distribution<double>(0.0, 20.0)(random);
    SCOPED_TRACE(stays_s);
    const double by_goal_s = arrives_s(to_place("a", {0.6, 0.0}, "a"), stays_s);
    evaluations += cell->planning().evaluations;
    const double by_line_s = arrives_s(go("a", {-1, 0}, {0.6, 0}, 1.6, "a"), stays_s);
    EXPECT_LE(by_goal_s, by_line_s + 1.0);
    goals_s += by_goal_s;
    lines_s += by_line_s;
  }
  std::printf(
      "%s: arrives after %.1f s in the mean, by the straight way after %.1f s; %.0f "
      "evaluations a run\n",
      GetParam().c_str(), goals_s / kRuns, lines_s / kRuns,
      static_cast<double>(evaluations) / kRuns);
  EXPECT_LT(goals_s, lines_s);
}

}  // namespace
}  // namespace armloom

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "test/experiments/claims.h"
#include "test/experiments/job_delays.h"
#include "test/experiments/run_all.h"
#include "test/experiments/tables.h"

namespace armloom::experiments {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

ConflictTable table_of(std::size_t rows, const std::string& cells) {
  ConflictTable table{rows, cells.size() / rows, {}};
  for (const char cell : cells) table.conflict.push_back(cell == '#' ? 1 : 0);
  return table;
}

std::size_t size_of(const ChosenMoments& chosen) {
  return static_cast<std::size_t>(std::ranges::count(chosen.rows, 1) +
                                  std::ranges::count(chosen.columns, 1));
}

TEST(Exclusion, ContainsTheRowsAndColumnsOfABlock) {
  const ChosenMoments chosen = largest_exclusion(table_of(4,
                                                          "....."
                                                          ".###."
                                                          ".###."
                                                          ".###."));
  EXPECT_THAT(chosen.rows, ElementsAre(0, 1, 1, 1));
  EXPECT_THAT(chosen.columns, ElementsAre(0, 1, 1, 1, 0));
}

TEST(Exclusion, IsOneWholeSideIfNothingConflicts) {
  EXPECT_EQ(size_of(largest_exclusion(table_of(2, "......"))), 3U);
}

// Tries all sets of rows.
std::size_t largest_by_trying(const ConflictTable& table) {
  std::size_t most = 0;
  for (std::size_t rows = 0; rows < (std::size_t{1} << table.rows); ++rows) {
    std::size_t size = 0;
    for (std::size_t a = 0; a < table.rows; ++a) size += rows >> a & 1U;
    for (std::size_t b = 0; b < table.columns; ++b) {
      bool all = true;
      for (std::size_t a = 0; a < table.rows; ++a) {
        if ((rows >> a & 1U) != 0) all = all && table.conflict[a * table.columns + b] != 0;
      }
      size += all ? 1 : 0;
    }
    most = std::max(most, size);
  }
  return most;
}

TEST(Exclusion, MatchesExhaustiveSearch) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    ConflictTable table{1 + random() % 9, 1 + random() % 9, {}};
    const auto density = 1 + random() % 9;
    table.conflict.resize(table.rows * table.columns);
    for (char& cell : table.conflict) cell = random() % 10 < density ? 1 : 0;

    const ChosenMoments chosen = largest_exclusion(table);

    EXPECT_EQ(size_of(chosen), largest_by_trying(table)) << "table " << i;
    for (std::size_t a = 0; a < table.rows; ++a) {
      for (std::size_t b = 0; b < table.columns; ++b) {
        if (chosen.rows[a] == 0 || chosen.columns[b] == 0) continue;
        EXPECT_EQ(table.conflict[a * table.columns + b], 1) << "table " << i;
      }
    }
  }
}

TEST(Exclusion, OfAllArmsContainsNoCompatiblePair) {
  // Moments 0 and 1 are compatible with moment 3 only.
  const std::vector<char> free = {0, 0, 0, 1,  //
                                  0, 0, 0, 1,  //
                                  0, 0, 0, 0,  //
                                  1, 1, 0, 0};
  EXPECT_THAT(exclusion_of_all(free, 4), ElementsAre(1, 1, 1, 0));
}

TEST(Exclusion, CountsStepsBetweenChosenNeighborsOfOneMotion) {
  EXPECT_EQ(steps_chosen({1, 1, 1, 0, 1, 1, 1}, {0, 0, 0, 0, 0, 0, 1}), 3U);
}

TEST(LowerBound, OfOneFixtureIsTheSumOfTheTimesInTheFixture) {
  // Each of the two arms is in the fixture for at least 2 s.
  const Workload workload = workload_kind("one_fixture").make(1);
  std::vector<Work> work;
  double inside_s = 0.0;
  double all_s = 0.0;
  for (const PlannedJob& job : workload.jobs) {
    if (!job.timed.job.key.starts_with("left-1-") && !job.timed.job.key.starts_with("right-1-")) {
      continue;
    }
    work.push_back({job.arm, job.trajectory});
    all_s += to_seconds(job.trajectory->duration());
    const auto& points = job.timed.job.trajectory.points;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].positions != points[i - 1].positions) continue;
      inside_s += points[i].time_from_start_s - points[i - 1].time_from_start_s;
    }
  }
  ASSERT_EQ(work.size(), 2U);
  ASSERT_GT(inside_s, 4.0);

  const LowerBound bound = lower_bound(workload.cell, work, std::chrono::milliseconds(50));

  EXPECT_GT(bound.excluding_s, inside_s - 0.2);
  EXPECT_LT(bound.excluding_s, all_s);
}

TEST(LowerBound, OfArmsThatNeverMeetIsTheBusiestArmsWork) {
  const Workload workload = workload_kind("apart").make(1);
  std::vector<Work> work;
  double left_s = 0.0;
  for (const PlannedJob& job : workload.jobs) {
    if (job.arm == ArmId(1) && job.timed.job.key != "right-1-tend") continue;
    work.push_back({job.arm, job.trajectory});
    if (job.arm == ArmId(0)) left_s += to_seconds(job.trajectory->duration());
  }
  const LowerBound bound = lower_bound(workload.cell, work, std::chrono::milliseconds(50));
  EXPECT_EQ(bound.busiest, "left");
  EXPECT_DOUBLE_EQ(bound.bound_s(), left_s);
}

TEST(Workloads, ShortAndLongTasksAreEqualWork) {
  for (const std::uint64_t seed : {1U, 2U}) {
    Duration shorts{};
    Duration longs{};
    int count = 0;
    for (const PlannedJob& job : workload_kind("short_beside_long").make(seed).jobs) {
      if (job.kind == "short") shorts += job.trajectory->duration();
      if (job.kind == "long") longs += job.trajectory->duration();
      count += job.kind == "short" ? 1 : job.kind == "long" ? -3 : 0;
    }
    EXPECT_EQ(count, 0);
    EXPECT_NEAR(to_seconds(shorts), to_seconds(longs), 0.05);
  }
}

TEST(Workloads, AreDeterministicForASeed) {
  const auto first_goal = [](std::uint64_t seed) {
    return Eigen::VectorXd(
        workload_kind("pick_and_place").make(seed).jobs.front().trajectory->goal());
  };
  EXPECT_EQ(first_goal(5), first_goal(5));
  EXPECT_NE(first_goal(5), first_goal(6));
}

TEST(Experiments, ResultsAreIndependentOfTheNumberOfThreads) {
  Plan plan{{workload_kind("one_fixture")}, {"certified", "earliest_start"}, 2, 1};
  const std::string once = results_csv(run_all(plan).rows);
  plan.threads = 2;
  EXPECT_EQ(results_csv(run_all(plan).rows), once);
}

RunRow row(const std::string& policy, double makespan_s) {
  RunRow made{.workload = "pick_and_place", .policy = policy, .seed = 1, .jobs = 4};
  made.makespan_s = makespan_s;
  made.limits.bound.own_s = 50.0;
  made.limits.optimum.least_s = 55.0;
  made.busy = {0.5, 0.5};
  made.together = 0.5;
  return made;
}

std::vector<bool> verdicts(const std::vector<RunRow>& rows) {
  std::vector<bool> holds;
  for (const Claim& claim : claims(Plan{{workload_kind("pick_and_place")}}, rows, "coordinated")) {
    holds.push_back(claim.holds);
  }
  return holds;
}

TEST(Claims, FollowTheMeasuredValues) {
  // The claims in order: lockstep, sequential, order, both move, optimum is a bound, near the
  // optimum, all succeed.
  std::vector<RunRow> rows = {row("sequential", 100.0), row("lockstep", 80.0),
                              row("certified", 70.0), row("coordinated", 55.9)};
  EXPECT_THAT(verdicts(rows), ElementsAre(true, true, true, true, true, true, true));
  // 76.7 % of lockstep's makespan, 86 % of sequential's, 3.6 % above the optimum
  rows[3].makespan_s = 57.0;
  rows[3].together = 0.0;
  EXPECT_THAT(verdicts(rows), ElementsAre(false, true, true, false, true, false, true));
  rows[3].makespan_s = 71.5;  // 2.1 % behind
  rows[0].not_succeeded = 1;
  EXPECT_THAT(verdicts(rows), ElementsAre(false, false, false, false, true, false, false));
}

TEST(Claims, CompareEachSeedAndTheOptimum) {
  // The claims in order: order, both move, optimum is a bound, near the optimum, never behind
  // earliest_start, all succeed.
  std::vector<RunRow> rows = {row("timed_discrete", 50.0), row("earliest_start", 55.2),
                              row("coordinated", 55.7)};
  EXPECT_THAT(verdicts(rows), ElementsAre(true, true, true, true, true, true));
  rows[2].makespan_s = 55.9;  // 1.3 % behind
  EXPECT_THAT(verdicts(rows), ElementsAre(true, true, true, true, false, true));
  rows[1].makespan_s = 54.9;  // below the optimum, which is impossible
  rows[2].makespan_s = 55.2;
  EXPECT_THAT(verdicts(rows), ElementsAre(true, true, false, true, true, true));
}

TEST(Delays, ExtendTheMakespanByTheStatedTime) {
  Workload workload = workload_kind("shuttles").make(1);
  workload.jobs.erase(workload.jobs.begin() + 4, workload.jobs.end());
  const double before_s = run_policy(workload, "shuttles", "sequential", 1, {}).makespan_s;
  workload.jobs[2].delay = JobDelay{1.0, 0.5};
  const double after_s = run_policy(workload, "shuttles", "sequential", 1, {}).makespan_s;
  const double twice_s = to_seconds(workload.jobs[2].trajectory->duration());
  EXPECT_NEAR(after_s - before_s, 1.0 + twice_s, 0.1);
}

TEST(Delays, KeepThePath) {
  const Workload workload = workload_kind("shuttles").make(1);
  const Trajectory& motion = *workload.jobs[2].trajectory;
  const TrajectoryPtr late = as_delayed(motion, {1.0, 0.5});
  EXPECT_EQ(late->duration(), 1s + 2 * motion.duration());
  Eigen::VectorXd planned;
  Eigen::VectorXd made;
  late->sample_positions(999ms, made);
  EXPECT_EQ(made, motion.start());
  for (Duration time{}; time <= motion.duration(); time += 10ms) {
    motion.sample_positions(time, planned);
    late->sample_positions(1s + 2 * time, made);
    EXPECT_LT((planned - made).lpNorm<Eigen::Infinity>(), 1e-9) << to_seconds(time);
  }
}

TEST(Delays, AffectTenToThirtyPercentOfTheJobs) {
  std::size_t least = 100;
  std::size_t most = 0;
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    std::vector<PlannedJob> jobs(100, PlannedJob{.arm = ArmId(0)});
    delay_some(jobs, seed);
    const auto delayed = static_cast<std::size_t>(
        std::ranges::count_if(jobs, [](const PlannedJob& job) { return job.delay.has_value(); }));
    least = std::min(least, delayed);
    most = std::max(most, delayed);
    all += delayed;
  }
  EXPECT_NEAR(static_cast<double>(all) / 5000.0, 0.2, 0.03);
  EXPECT_GE(least, 2U);  // for a share of 0.1
  EXPECT_LE(most, 45U);  // for a share of 0.3
}

}  // namespace
}  // namespace armloom::experiments

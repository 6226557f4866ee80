// The paper's third experiment: two and four arms with jobs that block each other for good.
// Compares three settings: abort after the timeout, retreat, replan.
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>

#include "core/executive/known_policies.h"
#include "core/executive/simulation.h"
#include "core/model/cell/build_cell.h"
#include "test/scenarios/seeds.h"
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

constexpr double kHalf_m = 0.9;   // half the side of the square that holds all places
constexpr double kApart_m = 0.3;  // for balls of 10 cm radius at rest
constexpr int kJobsOfEach = 3;

// A workload of straight paths between random places. About every second goal is the home of
// another arm.
struct Workload {
  CellDescription cell;
  std::vector<TimedJob> jobs;
};

class WorkloadMaker {
 public:
  WorkloadMaker(std::size_t arms, std::uint64_t seed) : random_(seed) {
    while (stands_.size() < arms) {
      const Place_m place = anywhere();
      if (is_free(place, arms)) stands_.push_back(place);
    }
  }

  Workload make() {
    Workload load{.cell = gantries(OnIdleBlocker::report), .jobs = {}};
    const RobotDescription like = load.cell.robots.front();
    load.cell.robots.clear();
    for (std::size_t arm = 0; arm < stands_.size(); ++arm) {
      RobotDescription robot = like;
      robot.name = robot.arms[0].name = name_of(arm);
      robot.prefix = name_of(arm) + "_";
      robot.arms[0].home = {stands_[arm].first, stands_[arm].second};
      load.cell.robots.push_back(std::move(robot));
    }
    const std::vector<Place_m> homes = stands_;
    for (int job = 0; job < kJobsOfEach; ++job) {
      for (std::size_t arm = 0; arm < stands_.size(); ++arm) {
        Place_m to = homes[(arm + 1 + static_cast<std::size_t>(job)) % homes.size()];
        if (std::uniform_int_distribution(0, 1)(random_) == 0 || to == stands_[arm])
          to = anywhere();
        const double length_m =
            std::hypot(to.first - stands_[arm].first, to.second - stands_[arm].second);
        const std::string key = name_of(arm) + std::to_string(job);
        load.jobs.push_back({TimePoint{} + std::chrono::milliseconds(200 * job),
                             go(name_of(arm), stands_[arm], to, std::max(1.0, 3 * length_m), key)});
        stands_[arm] = to;
      }
    }
    return load;
  }

 private:
  static std::string name_of(std::size_t arm) { return {static_cast<char>('a' + arm)}; }
  Place_m anywhere() {
    std::uniform_real_distribution<double> at(-kHalf_m, kHalf_m);
    const double x_m = at(random_);
    return {x_m, at(random_)};
  }
  [[nodiscard]] bool is_free(const Place_m& place, std::size_t but) const {
    for (std::size_t i = 0; i < stands_.size(); ++i) {
      const double apart_m =
          std::hypot(place.first - stands_[i].first, place.second - stands_[i].second);
      if (i != but && apart_m < kApart_m) return false;
    }
    return true;
  }
  std::mt19937_64 random_;
  std::vector<Place_m> stands_;
};

// Records the smallest measured distance between two balls.
struct Closest final : Observer {
  void on_event(const Event& event) override {
    const auto* job = std::get_if<JobView>(&event.body);
    if (job != nullptr && is_terminal(job->state) && job->ways.another_way) {
      replanned += job->ways.another_way->done;
    }
  }
  void on_tick(TimePoint, const Configuration& q) override {
    for (Eigen::Index a = 0; a < q.size(); a += 2) {
      for (Eigen::Index b = 0; b < a; b += 2) {
        closest_m = std::min(closest_m, (q.segment<2>(a) - q.segment<2>(b)).norm() - 0.2);
      }
    }
  }
  void on_state(const StateFrame&) override {}
  double closest_m = 1e9;
  std::uint64_t replanned = 0;
};

struct Outcome {
  std::size_t done = 0;  // client jobs that succeeded
  double makespan_s = 0.0;
  std::uint64_t replanned = 0;
  Planning planning = {};
  std::map<std::string, std::string> undone = {};  // by key: how the job ended instead
};

// Returns the jobs that only `than` finished, with how they ended in `run`.
std::string lost(const Outcome& than, const Outcome& run) {
  std::string text;
  for (const auto& [key, how] : run.undone) {
    if (!than.undone.contains(key)) text += "\n    " + key + ": " + how;
  }
  return text;
}

enum class Way { abort, park, replan };
constexpr Way kWays[] = {Way::abort, Way::park, Way::replan};
constexpr const char* kNames[] = {"abort", "park", "replan"};

Outcome run(Workload load, Way way) {
  auto& scheduling = load.cell.scheduling;
  scheduling.on_idle_blocker = way == Way::abort  ? OnIdleBlocker::report
                               : way == Way::park ? OnIdleBlocker::park
                                                  : OnIdleBlocker::replan;
  scheduling.backlog_timeout = 15s;
  for (TimedJob& job : load.jobs) {
    if (way == Way::replan) job.job.terms.on_timeout = OnTimeout::replan;
    job.job.terms.move_to_start = MoveToStart::plan;
  }
  Closest seen;
  const std::size_t count = load.jobs.size();
  const auto result = simulate(*build_cell(load.cell), ExecutiveOptions{.policy = "earliest_start"},
                               {load.jobs, at(2000s)}, seen);
  Outcome outcome;
  EXPECT_TRUE(result) << result.error().front().detail;
  if (!result) return outcome;
  EXPECT_TRUE(result->all_ended) << "jobs hang";
  EXPECT_GT(seen.closest_m, 0.019) << kNames[static_cast<int>(way)];
  std::size_t of_clients = 0;
  for (const JobView& job : result->jobs) {
    if (job.system_job) continue;
    ++of_clients;
    if (job.state != JobState::succeeded) {
      outcome.undone[job.key] = std::string(to_string(*job.reason())) + ", " + job.detail();
      continue;
    }
    ++outcome.done;
    outcome.makespan_s = std::max(outcome.makespan_s, to_seconds(*job.times.ended_at));
  }
  EXPECT_EQ(of_clients + result->refused.size(), count);
  outcome.replanned = seen.replanned;
  outcome.planning = result->planning;
  return outcome;
}

class BlockedGoals : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Arms, BlockedGoals, ::testing::Values(2, 4));

TEST_P(BlockedGoals, ReplanFinishesMostJobsWithoutContact) {
  const std::uint64_t seeds = seed_count(6);
  std::size_t jobs = 0, fewer = 0;
  Outcome sum[3];
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    const Workload load = WorkloadMaker(GetParam(), seed).make();
    jobs += load.jobs.size();
    Outcome runs[3];
    for (int i = 0; i < 3; ++i) {
      runs[i] = run(load, kWays[i]);
      sum[i].done += runs[i].done;
      sum[i].makespan_s += runs[i].makespan_s;
      sum[i].replanned += runs[i].replanned;
      sum[i].planning.plans += runs[i].planning.plans;
      sum[i].planning.evaluations += runs[i].planning.evaluations;
      sum[i].planning.wall += runs[i].planning.wall;
    }
    const int most = runs[0].done >= runs[1].done ? 0 : 1;
    if (runs[2].done >= runs[most].done) continue;
    ++fewer;
    std::printf("seed %llu: %s did %zu, replan %zu, which left undone%s\n",
                static_cast<unsigned long long>(seed), kNames[most], runs[most].done, runs[2].done,
                lost(runs[most], runs[2]).c_str());
  }
  for (int i = 0; i < 3; ++i) {
    std::printf(
        "%zu arms, %s: %zu of %zu jobs, makespan %.1f s in the mean, %llu planned anew; "
        "%llu plans, %.1f thousand evaluations and %.1f ms of planning a run\n",
        GetParam(), kNames[i], sum[i].done, jobs, sum[i].makespan_s / static_cast<double>(seeds),
        static_cast<unsigned long long>(sum[i].replanned),
        static_cast<unsigned long long>(sum[i].planning.plans),
        1e-3 * static_cast<double>(sum[i].planning.evaluations) / static_cast<double>(seeds),
        1e3 * to_seconds(sum[i].planning.wall) / static_cast<double>(seeds));
  }
  std::printf("%zu of %llu seeds: replan did fewer than one of the others\n", fewer,
              static_cast<unsigned long long>(seeds));
  EXPECT_EQ(fewer, 0U);
  EXPECT_GT(sum[2].done, sum[0].done);
  EXPECT_GE(sum[2].done, sum[1].done);
}

}  // namespace
}  // namespace armloom

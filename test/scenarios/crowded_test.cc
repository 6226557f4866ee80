// Crowded worlds that have a solution. Under `coordinated` nearly every job succeeds. Under any
// policy every other job ends with the blocker named, retreats do not repeat without end, and
// nothing ever touches. Runs 100 worlds under `coordinated` and 20 under each other policy;
// ARMLOOM_SEEDS=1000 runs 1,000 and 200. ARMLOOM_TOLD=1 prints every unsolved world.
#include <gtest/gtest.h>

#include <iostream>
#include <map>

#include "core/executive/known_policies.h"
#include "core/model/cell/build_cell.h"
#include "test/scenarios/crowded_oracle.h"
#include "test/scenarios/crowded_workloads.h"
#include "test/scenarios/random_faults.h"
#include "test/scenarios/seeds.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kWorlds = 100;
// At most this many server-initiated jobs for each client job. More would mean that arms go back
// and forth.
constexpr std::size_t kOwnJobsMax = 8;

struct Tally {
  std::size_t worlds = 0, solved = 0;
  std::size_t jobs = 0, succeeded = 0;
  std::size_t deadlocks = 0;     // failed with a named deadlock cycle
  std::size_t waits = 0;         // expired with a named blocker
  std::size_t consequences = 0;  // failed because an earlier job of the arm did
  std::size_t refused = 0;       // at submission
  std::size_t silent = 0;
  std::size_t own = 0;       // server-initiated jobs
  std::size_t own_most = 0;  // in one world
  std::uint64_t monitor_stops = 0;
  // Unsolved worlds, by the oracle's verdict:
  std::size_t dead_ends = 0;  // some motion was started after which no solution exists
  std::size_t missed = 0;     // the rest could be done, but nothing starts
  std::size_t beyond = 0;     // the oracle finds no solution from the beginning
  double smallest_m = 1e9;
  double makespan_s = 0.0, solution_s = 0.0;  // sums over solved worlds
};

// Returns false for server-initiated jobs (retreats).
bool is_of_a_client(const JobView& job) {
  return job.key.size() == 2 && job.key.starts_with(job.arms.front());
}

void count(const SimulationResult& result, Tally& tally) {
  std::map<std::string, bool> failed;  // by arm: an earlier job or return motion failed
  for (const JobView& job : result.jobs) {
    if (!is_of_a_client(job)) {
      const bool returns = job.name.find("returns") != std::string::npos;
      if (returns && job.state != JobState::succeeded) failed[job.arms.front()] = true;
      continue;
    }
    ++tally.jobs;
    if (job.state == JobState::succeeded) {
      ++tally.succeeded;
      continue;
    }
    bool& before = failed[job.arms.front()];
    if (job.reason() == Reason::deadlock && job.cycle.size() >= 2) {
      ++tally.deadlocks;
    } else if (job.reason() == Reason::backlog_timeout && !job.waits_on.empty()) {
      ++tally.waits;
    } else if (job.reason() == Reason::start_mismatch && before) {
      ++tally.consequences;
    } else {
      ++tally.silent;
    }
    before = true;
  }
}

std::size_t own_jobs(const SimulationResult& result) {
  return result.jobs.size() -
         static_cast<std::size_t>(std::ranges::count_if(result.jobs, is_of_a_client));
}

double solution_s(const CrowdedWorkload& world) {
  double sum = 0.0;
  for (const auto& group : world.solution) {
    double longest = 0.0;
    for (const DiscMotion& one : group) longest = std::max(longest, one.duration_s());
    sum += longest;
  }
  return sum;
}

// Returns why the world was not solved: the job whose start left no solution, if there is such a
// job.
std::string went_wrong(const CrowdedWorkload& world, const SimulationResult& result, Tally& tally) {
  CrowdedOracle oracle(world);
  std::vector<std::size_t> done(world.homes.size(), 0);
  if (!oracle.solvable(done)) {
    ++tally.beyond;
    return "no solution is known without moves aside";
  }
  std::vector<const JobView*> begun;
  TimePoint first_end = TimePoint::max();  // of a job that did not succeed
  for (const JobView& job : result.jobs) {
    if (job.times.started_at && is_of_a_client(job)) begun.push_back(&job);
    if (job.state != JobState::succeeded && job.times.ended_at) {
      first_end = std::min(first_end, *job.times.ended_at);
    }
  }
  std::ranges::sort(begun, {}, [](const JobView* job) { return *job->times.started_at; });
  std::string last_bad;
  for (const JobView* job : begun) {
    if (*job->times.started_at >= first_end) break;
    ++done[static_cast<std::size_t>(job->arms.front()[0] - 'a')];
    if (oracle.solvable(done)) {
      last_bad.clear();
    } else if (last_bad.empty()) {
      last_bad = job->key;
    }
  }
  ++(last_bad.empty() ? tally.missed : tally.dead_ends);
  return last_bad.empty() ? "what is left could be done" : "a dead end since " + last_bad;
}

void tell(const CrowdedWorkload& world, const SimulationResult& result, const std::string& why) {
  std::cout << "--- " << to_string(world.crowd) << " seed " << world.seed << ", "
            << world.homes.size() << " arms: " << why << "; solution:";
  for (const auto& group : world.solution) {
    std::cout << " [";
    for (const DiscMotion& one : group) {
      std::cout << " " << disc_name(one.arm) << (one.of_a_client ? "" : "*");
      for (const auto& place : one.way) std::cout << " (" << place.x() << "," << place.y() << ")";
    }
    std::cout << " ]";
  }
  std::cout << "\n";
  for (const JobView& job : result.jobs) {
    std::cout << "  " << to_seconds(job.times.submitted_at) << " -> "
              << (job.times.started_at ? to_seconds(*job.times.started_at) : -1.0) << ".."
              << (job.times.ended_at ? to_seconds(*job.times.ended_at) : -1.0) << " " << told(job)
              << "\n";
  }
}

struct Way {
  std::string policy = "coordinated";
  bool corners = false;  // every arm has four named poses outside the work area
};
std::string to_string(const Way& way) { return way.policy + (way.corners ? " with corners" : ""); }

void run(const Way& way, Crowd crowd, std::uint64_t seed, Tally& tally) {
  const CrowdedWorkload world = make_crowded(crowd, seed);
  const std::string name =
      to_string(way) + ", " + to_string(crowd) + " seed " + std::to_string(seed);
  CellDescription description = world.cell();
  description.scheduling.on_idle_blocker = OnIdleBlocker::park;
  for (RobotDescription& robot : description.robots) {
    if (way.corners) robot.srdf = source_dir() + "/test/scenarios/data/gantry_with_corners.srdf";
  }
  auto cell = build_cell(description);
  ASSERT_TRUE(cell) << name;
  ClosestDiscs closest;
  const auto result =
      simulate(*cell, ExecutiveOptions{.policy = way.policy}, {world.jobs(), at(600s)}, closest);
  ASSERT_TRUE(result) << name << ": " << result.error().front().detail;
  const std::size_t failed_before = tally.jobs - tally.succeeded;
  // A refused job must have a reason: its arm has retreated, so the job starts elsewhere.
  for (const auto& refused : result->refused) {
    EXPECT_FALSE(refused.problems.empty()) << name;
    ++tally.refused;
    ++tally.jobs;
    if (std::getenv("ARMLOOM_TOLD") != nullptr) {
      std::cout << name << " refused: " << refused.problems.front().detail << "\n";
    }
  }
  EXPECT_GT(closest.smallest_m, 0.0) << name << ": contact at " << to_seconds(closest.when) << " s";
  tally.smallest_m = std::min(tally.smallest_m, closest.smallest_m);
  tally.monitor_stops += result->figures.monitor_stops;
  if (way.policy == "timed_discrete" && result->figures.monitor_stops > 0) {
    return;  // no promise between time steps; this test resumes no arm that the monitor stopped
  }
  EXPECT_TRUE(result->all_ended) << name << ": jobs hang";
  const std::size_t silent_before = tally.silent;
  count(*result, tally);
  const std::size_t own = own_jobs(*result);
  EXPECT_LE(own, kOwnJobsMax * world.submitted.size()) << name << ": arms go to and fro";
  tally.own += own;
  tally.own_most = std::max(tally.own_most, own);
  EXPECT_EQ(tally.silent, silent_before) << name << ": a job ends without naming what blocked it";
  EXPECT_EQ(result->figures.monitor_stops, 0U)
      << name << ": closest " << closest.smallest_m << " m at " << to_seconds(closest.when) << " s";
  ++tally.worlds;
  if (tally.jobs - tally.succeeded == failed_before) {
    ++tally.solved;
    tally.makespan_s += to_seconds(result->figures.last_end);
    tally.solution_s += solution_s(world);
  } else {
    const std::string why = went_wrong(world, *result, tally);
    if (std::getenv("ARMLOOM_TOLD") != nullptr) tell(world, *result, why);
  }
}

// Returns part / whole, or 0 if `whole` is 0, so that claims about jobs fail if no job ran.
double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Tally run_all(const Way& way, Crowd crowd, std::uint64_t worlds) {
  Tally tally;
  const char* only = std::getenv("ARMLOOM_ONLY");
  for (std::uint64_t seed = 1; seed <= worlds; ++seed) {
    if (only == nullptr || std::to_string(seed) == only) run(way, crowd, seed, tally);
  }
  EXPECT_GE(tally.worlds, 1U) << "nothing ran";
  std::cout << to_string(way) << ", " << to_string(crowd) << ": " << tally.solved << " of "
            << tally.worlds << " worlds solved; of " << tally.jobs << " jobs " << tally.succeeded
            << " (" << 100.0 * share(tally.succeeded, tally.jobs) << " %) succeeded, "
            << tally.deadlocks << " in named rings, " << tally.waits << " waits by name, "
            << tally.consequences << " after these, " << tally.refused << " refused, "
            << tally.silent << " silent; " << tally.own << " of the server's own, at most "
            << tally.own_most << " in a world; " << tally.monitor_stops
            << " monitor stops, closest " << tally.smallest_m << " m; " << tally.makespan_s
            << " s where the solutions one by one take " << tally.solution_s
            << " s; not solved: " << tally.dead_ends << " dead ends, " << tally.missed
            << " missed, " << tally.beyond << " beyond the oracle" << std::endl;
  return tally;
}

TEST(CrowdedWorkloads, HaveASolutionThatKeepsItsDistance) {
  for (const Crowd crowd : kCrowds) {
    for (std::uint64_t seed = 1; seed <= seed_count(kWorlds, 5); ++seed) {
      const CrowdedWorkload world = make_crowded(crowd, seed);
      EXPECT_GE(smallest_kept_m(world), kKeptOneByOne_m) << to_string(crowd) << " seed " << seed;
      for (const auto& submitted : world.submitted) EXPECT_TRUE(submitted.motion.of_a_client);
    }
  }
}

TEST(CrowdedWorlds, JobsSucceedOrNameTheirBlocker) {
  std::size_t jobs = 0, succeeded = 0;
  for (const Crowd crowd : kCrowds) {
    if (crowd == Crowd::parked) continue;
    const Tally tally = run_all({}, crowd, seed_count(kWorlds, 4));
    jobs += tally.jobs;
    succeeded += tally.succeeded;
  }
  EXPECT_GE(share(succeeded, jobs), 0.99) << succeeded << " of " << jobs << " jobs";
}

TEST(CrowdedWorlds, ParkedArmsRetreat) {
  const Tally tally = run_all({}, Crowd::parked, seed_count(kWorlds, 4));
  EXPECT_GE(share(tally.succeeded, tally.jobs), 0.99);
}

// Found with four idle arms: each had a retreat that waited for the next arm's retreat.
TEST(CrowdedWorlds, RetreatsThatWaitForEachOtherEnd) {
  Tally tally;
  run({.policy = "lockstep"}, Crowd::ring4, 310, tally);
  EXPECT_EQ(tally.worlds, 1U);
}

class CrowdedWorldsUnder : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, CrowdedWorldsUnder, ::testing::ValuesIn(known_policies()));

TEST_P(CrowdedWorldsUnder, JobsSucceedOrNameTheirBlocker) {
  for (const Crowd crowd : kCrowds) {
    (void)run_all({GetParam(), false}, crowd, seed_count(kWorlds, 25));
  }
}

TEST_P(CrowdedWorldsUnder, MostJobsSucceedIfArmsHaveRetreatPoses) {
  std::size_t jobs = 0, succeeded = 0;
  for (const Crowd crowd : kCrowds) {
    const Tally tally = run_all({GetParam(), true}, crowd, seed_count(kWorlds, 25));
    jobs += tally.jobs;
    succeeded += tally.succeeded;
  }
  EXPECT_GE(share(succeeded, jobs), 0.9) << succeeded << " of " << jobs << " jobs";
}

}  // namespace
}  // namespace armloom

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test/experiments/optimum.h"
#include "test/experiments/workloads.h"

namespace armloom::experiments {

// Policy name of the runs with the first arm alone.
inline constexpr const char* kOneArm = "one arm";

struct Limits {
  LowerBound bound;
  Optimum optimum;
};

// Metrics of one run; shares are of the makespan. Deterministic except judging_s.
struct RunRow {
  std::string workload;
  std::string policy;
  std::uint64_t seed = 0;
  std::size_t jobs = 0;
  std::size_t not_succeeded = 0;
  double makespan_s = 0.0;   // from the first submission to the last end
  Limits limits;             // zero if they are not known
  std::vector<double> busy;  // per arm: share of time under way
  double together = 0.0;     // share of time in which the joints of at least two arms move
  // Time until a job starts, from when the previous job of its arm has ended (or, if later, from
  // its submission).
  double wait_mean_s = 0.0;
  double wait_max_s = 0.0;
  double held_mean_s = 0.0;  // mean time by which jobs, from start to end, exceed their duration
  double clearance_m = 0.0;  // smallest clearance seen by the monitor; +inf: never near
  std::uint64_t monitor_stops = 0;
  std::size_t backlogged = 0;  // jobs that were in the backlog
  std::uint64_t judgements = 0;
  std::uint64_t evaluations = 0;
  double judging_s = 0.0;  // wall time of all checks
};

// Runs the jobs under a policy on simulated time; kOneArm runs workload.one_arm. Reports
// unsuccessful jobs on stderr. Throws std::runtime_error if the executive cannot be created or
// rejects a job.
[[nodiscard]] RunRow run_policy(const Workload& workload, const std::string& name,
                                const std::string& policy, std::uint64_t seed,
                                const Limits& limits);

// Mean and sample standard deviation of several runs.
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};
[[nodiscard]] Spread spread_of(const std::vector<double>& values);

}  // namespace armloom::experiments

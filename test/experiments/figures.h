#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "test/experiments/optimum.h"
#include "test/experiments/workloads.h"

namespace armloom::experiments {

// What the first arm does alone, under the name of a policy.
inline constexpr const char* kOneArm = "one arm";

// What no policy can beat, whichever it is.
struct Limits {
  LowerBound bound;
  Optimum optimum;
};

// The figures of one run; shares are of the makespan. All but judging_s repeat for a seed.
struct RunRow {
  std::string workload;
  std::string policy;
  std::uint64_t seed = 0;
  std::size_t jobs = 0;
  std::size_t not_succeeded = 0;
  double makespan_s = 0.0;  // from the first submission to the last end
  Limits limits;
  std::vector<double> busy;  // per arm: share under way
  double together = 0.0;     // share in which the joints of at least two arms really move
  // Of a job that is the first of its arm, from then (or from its submission) to its start.
  double wait_mean_s = 0.0;
  double wait_max_s = 0.0;
  double held_mean_s = 0.0;  // what a job takes from its start to its end beyond its duration
  double clearance_m = 0.0;  // smallest that the monitor saw; +inf: never near
  std::uint64_t monitor_stops = 0;
  std::size_t backlogged = 0;  // jobs that were in the backlog
  std::uint64_t judgements = 0;
  std::uint64_t evaluations = 0;
  double judging_s = 0.0;  // of the machine
};

// Runs the jobs under a policy, on simulated time. `policy` kOneArm: workload.one_arm, one job
// after the other. Says on stderr which jobs did not succeed. Throws std::runtime_error when the
// executive cannot be made or a job is refused.
[[nodiscard]] RunRow run_policy(const Workload& workload, const std::string& name,
                                const std::string& policy, std::uint64_t seed,
                                const Limits& limits);

// Of several runs: mean and standard deviation (of the sample).
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};
[[nodiscard]] Spread spread_of(const std::vector<double>& values);

}  // namespace armloom::experiments

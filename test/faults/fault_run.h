#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/audit/audit.h"
#include "core/executive/simulation.h"
#include "test/faults/listed_faults.h"
#include "test/scenarios/random_jobs.h"

namespace armloom {

// The parameters of a run. Equal plans give equal runs.
struct FaultRunPlan {
  std::uint64_t seed = 1;
  RandomWorld world = RandomWorld::sliders;
  std::string policy = "coordinated";
  // The fault that occurs in one arm. If null, faults of the list occur all the time.
  const ListedFault* fault = nullptr;
  bool faulty = true;     // false: no fault, but noise and lag within the promises
  bool monitored = true;  // false switches the monitor off
  bool tasks = false;     // also jobs with steps, which pick and place parts
  bool verbose = false;   // prints jobs, alerts and faults to stderr
  Duration jobs_for = std::chrono::seconds(20);  // jobs are submitted for so long, ...
  std::size_t open_max = 1000;                   // ... while at most so many have not ended
};

struct FaultRunResult {
  std::size_t jobs = 0, succeeded = 0;
  std::size_t waiting = 0;              // jobs that have not ended, but state what they wait for
  std::vector<std::string> silent;      // jobs that have not ended and do not
  std::vector<std::string> lost;        // parts that were not at exactly one place
  std::optional<AuditFinding> contact;  // of the true positions
  bool may_touch = false;               // ListedFault::may_touch of a fault present at the contact
  double closest_m = 1e9;               // of all pairs of arms, and arms with the scene
  std::uint64_t guard_refusals = 0;
  // Arms without a fault that the monitor stopped, but not together with a faulty arm that takes
  // part in the same motion.
  struct MonitorStop {
    TimePoint time;
    ArmId arm;
    std::string why;
  };
  std::vector<MonitorStop> stops;
  std::size_t stops_of_faulty = 0;
  Duration simulated{};
  std::uint64_t fingerprint = 0;  // of the true positions and the events
};

// Runs jobs while faults occur. An operator resumes arms two seconds after they were stopped, and
// removes the faults then. The true positions, every 5 ms, are audited (core/audit).
[[nodiscard]] FaultRunResult run_with_faults(const FaultRunPlan& plan);

// An arm counts as endangered if, without the monitor, it would have come closer than this to
// another arm or an object within kEndangeredFor after the stop.
inline constexpr double kEndangered_m = 0.05;
inline constexpr Duration kEndangeredFor = std::chrono::seconds(5);

// Repeats the run without the monitor, up to kEndangeredFor after the stop: until the stop, both
// runs are the same. Returns the arm's smallest distance since then, at most 2 m.
[[nodiscard]] double distance_without_monitor(FaultRunPlan plan,
                                              const FaultRunResult::MonitorStop& stop);

}  // namespace armloom

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/executive/active_policy.h"
#include "core/executive/simulation.h"
#include "core/model/cell_description.h"
#include "test/scenarios/random_jobs.h"

namespace armloom {

// Sums over the runs of a soak.
struct SoakTally {
  std::size_t runs = 0, jobs = 0, succeeded = 0, own = 0, commands = 0, restarts = 0;
  std::uint64_t monitor_findings = 0;  // without a fault or an object
  std::uint64_t guard_refusals = 0;
  std::uint64_t too_close = 0;  // runs without a fault or an object in which arms came too close
  std::uint64_t hung = 0;       // runs that settled before all jobs ended
  double closest_m = 1e9;       // of two arms, in runs without a fault or an object
  double hours = 0.0;           // simulated
};

// Random sequences of commands, determined by a seed, with two to four sliders or two Pandas:
// - jobs (RandomJobs) and batches;
// - cancel, stop, resume, replan, PATCH and policy changes;
// - objects, faults and restarts;
// - with `slows`, changes of the speed override.
class Soak {
 public:
  // With `slows`, the speed override changes at random, too.
  Soak(std::uint64_t seed, RandomWorld world, const std::string& policy, bool slows = false);
  ~Soak();

  // Runs and adds the results to the tally. With `expects`, a broken promise fails the test.
  void run(SoakTally& tally, bool expects = true);

 private:
  struct Watch;
  void start(std::uint64_t first_job, std::vector<RestoredJob> left);
  Executive& executive() { return simulation_->executive(); }
  void submit(JobRequest request);
  void note(const Result<JobView>& accepted, const JobRequest& request);
  void command();
  void change_speed();
  void change_scene();
  void inject();
  void restart();
  void settle();

  Random random_;
  Random random_speed_;  // apart, so that a seed gives the same commands
  bool slows_;
  std::string policy_;
  CellPtr cell_;
  std::unique_ptr<RandomJobs> jobs_;
  std::unique_ptr<Watch> watch_;
  std::unique_ptr<Simulation> simulation_;
  std::map<std::string, JobRequest> requests_;  // by key
  bool may_fault_ = false, may_see_objects_ = false, disturbed_ = false;
  SoakTally* tally_ = nullptr;
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "test/scenarios/team_world.h"

namespace armloom {

// Of all worlds of a policy.
struct TeamTally {
  std::size_t jobs = 0, succeeded = 0, own = 0;
  double smallest_m = 1e9;          // where no controller gave up
  double smallest_fault_m = 1e9;    // where one did
  double smallest_in_step_m = 1e9;  // of two arms of one motion
  std::uint64_t monitor_stops = 0;
};

// One world, told by its seed: commands at random, until all has come to rest, and what is claimed.
class TeamsRun {
 public:
  TeamsRun(std::uint64_t seed, const std::string& policy);

  void run(TeamTally& tally);

 private:
  Executive& executive() { return simulation_->executive(); }
  static bool told() { return std::getenv("ARMLOOM_TOLD") != nullptr; }

  ArmId any_arm() { return ArmId{static_cast<std::uint32_t>(random_.index(arms_.size()))}; }

  // Of one to three arms, from where clients' jobs leave them.
  JobRequest random_job();
  double predicted(const Snapshot& now, std::size_t arm);
  void remember(const Result<JobView>& accepted, const JobRequest& request);
  void say(const std::string& what);
  void submit();
  void batch();
  void command();
  void cancel(const std::string& key);
  void change_scene();
  void inject(const std::string& arm);
  void note_own_jobs();
  // Jobs, queue and the last event of each job say the same.
  void compare();
  // Everything may go on, until nothing has happened for long.
  void settle();
  // By the monitor, or by a controller that gave up.
  bool stopped_in_vain();
  // An arm rests for ever in the way of each.
  void explain_what_waits();
  // What is left is canceled. An arm may be sent aside or back even then.
  void end_all();
  void judge(TeamTally& tally);
  void tell();

  Random random_;
  CellDescription description_;
  WatchedTeam watched_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::string> arms_;
  std::vector<double> left_;       // by clients' jobs
  std::vector<std::string> keys_;  // the server's own included
  std::set<std::string> own_;
  std::map<std::string, JobView> told_;  // as the last event of each job has it
  std::map<std::pair<std::string, std::string>, double> goals_;  // of job and arm
  std::size_t read_ = 0;
  bool delayed_ = false, commanded_ = false, may_fault_ = false, may_see_objects_ = false;
  bool faulted_ = false;
};

}  // namespace armloom

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

// Sums over all worlds of a policy.
struct TeamTally {
  std::size_t jobs = 0, succeeded = 0, own = 0;
  double smallest_m = 1e9;          // in worlds without an injected fault
  double smallest_fault_m = 1e9;    // in worlds with an injected fault
  double smallest_in_step_m = 1e9;  // between two arms of one motion
  std::uint64_t monitor_stops = 0;
};

// One random world, determined by its seed. Sends random commands until the world has settled, and
// checks what the server promises.
class TeamsRun {
 public:
  TeamsRun(std::uint64_t seed, const std::string& policy);

  void run(TeamTally& tally);

 private:
  Executive& executive() { return simulation_->executive(); }
  static bool told() { return std::getenv("ARMLOOM_TOLD") != nullptr; }

  ArmId any_arm() { return ArmId{static_cast<std::uint32_t>(random_.index(arms_.size()))}; }

  // Returns a job of one to three arms that starts where client jobs leave these arms.
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
  // Expects that jobs, queue and the last event of each job agree.
  void compare();
  // Resumes all arms repeatedly, until nothing has happened for kQuiet.
  void settle();
  // Returns true if a job waits for a stop (by the monitor or a controller fault).
  bool stopped_in_vain();
  // Expects that every waiting job waits, directly or not, for an arm without a job.
  void explain_what_waits();
  // Cancels the remaining jobs. Retreats and returns may still follow.
  void end_all();
  void judge(TeamTally& tally);
  void tell();

  Random random_;
  CellDescription description_;
  WatchedTeam watched_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::string> arms_;
  std::vector<double> left_;       // position where client jobs leave the arm
  std::vector<std::string> keys_;  // including server-initiated jobs
  std::set<std::string> own_;
  std::map<std::string, JobView> told_;                          // the last event of each job
  std::map<std::pair<std::string, std::string>, double> goals_;  // by job and arm
  std::size_t read_ = 0;
  bool delayed_ = false, commanded_ = false, may_fault_ = false, may_see_objects_ = false;
  bool faulted_ = false;
};

}  // namespace armloom

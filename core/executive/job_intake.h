#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/job_register.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// What a request has become once everything about it has been checked.
struct PreparedJob {
  std::string key;  // empty: one is to be given
  std::string name;
  std::vector<TrajectoryPtr> alternatives;  // the job's trajectory first; the only one, mostly
  std::vector<MotionGoal> goals;            // the trajectories are estimates, one for each
  JobTerms terms;
  std::vector<std::string> after;
  std::vector<TrajectoryPtr> returns;  // of its arms, to where their clients left them
};

// Memory that these hold.
[[nodiscard]] std::size_t bytes_of(const std::vector<TrajectoryPtr>& trajectories);

// Reads what clients ask for, against the cell and what has been accepted before. Changes nothing
// but what it knows of ways back.
class JobIntake {
 public:
  // What active jobs may take (ExecutiveOptions).
  struct ActiveMax {
    std::size_t jobs;
    std::size_t bytes;
  };
  // Both outlive it.
  JobIntake(CellPtr cell, const Scheduler& scheduler, const JobRegister& jobs, ActiveMax active_max)
      : cell_(std::move(cell)), scheduler_(scheduler), jobs_(jobs), active_max_(active_max) {}

  // Where joints will stand, and which keys are taken, when the jobs before it are accepted.
  struct Ahead {
    Configuration rest;
    std::unordered_set<std::string> keys;
    std::map<ArmId, TrajectoryPtr> ways_back;  // of arms that were sent aside
    std::vector<ArmId> open = {};              // whose end of `rest` is not known yet
    bool begins_anywhere = false;              // jobs need not begin at `rest`
    std::size_t jobs = 0;                      // accepted with it
    std::size_t bytes = 0;                     // of their trajectories
  };
  [[nodiscard]] Ahead ahead() const;
  // Everything that can be said against a request, before anything is stored. `ahead` then holds
  // what the next request of a batch finds.
  [[nodiscard]] Result<PreparedJob> prepare(JobRequest request, Ahead& ahead) const;
  // The scheduler's job, but for its id.
  [[nodiscard]] Submit submission(PreparedJob prepared) const;
  // Of an arm that was sent aside, before a job of this priority.
  [[nodiscard]] Submit return_of(TrajectoryPtr back, int priority) const;

  // What was prepared is accepted.
  void accepted(Ahead ahead) { ways_back_ = std::move(ahead.ways_back); }
  // The arm goes aside: where its clients left it, however often it does.
  void remember_way_back(ArmId arm, const Trajectory& way);
  // The arm goes elsewhere than where its clients left it.
  void forget_way_back(ArmId arm) { ways_back_.erase(arm); }
  // The server is ending: no job is taken from now on.
  void close() { is_closed_ = true; }

 private:
  [[nodiscard]] std::vector<TrajectoryPtr> read_motions(const JobRequest& request, Ahead& ahead,
                                                        std::vector<TrajectoryPtr>& returns,
                                                        Problems& problems) const;
  [[nodiscard]] std::vector<MotionGoal> read_goals(const JobRequest& request,
                                                   Problems& problems) const;
  [[nodiscard]] std::vector<TrajectoryPtr> estimates_for(const std::vector<MotionGoal>& goals,
                                                         Ahead& ahead) const;
  [[nodiscard]] std::optional<Problem> too_large(std::size_t bytes) const;
  void begin_where_open(const Trajectory& motion, Ahead& ahead) const;
  void find_bad_after(const JobRequest& request, const Ahead& ahead, Problems& problems) const;
  [[nodiscard]] std::vector<TrajectoryPtr> returns_for(const Trajectory& motion,
                                                       Ahead& ahead) const;

  CellPtr cell_;
  const Scheduler& scheduler_;
  const JobRegister& jobs_;
  ActiveMax active_max_;
  std::map<ArmId, TrajectoryPtr> ways_back_;
  bool is_closed_ = false;
};

}  // namespace armloom

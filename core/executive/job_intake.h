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

// A request after all checks.
struct PreparedJob {
  std::string key;  // generated if empty
  std::string name;
  std::vector<TrajectoryPtr> alternatives;  // the job's trajectory first, mostly the only one
  std::vector<MotionGoal> goals;            // one for each trajectory, which are then estimates
  JobTerms terms;
  std::vector<std::string> after;
  std::vector<TrajectoryPtr> returns;  // of its arms, to where the clients left them
};

[[nodiscard]] std::size_t bytes_of(const std::vector<TrajectoryPtr>& trajectories);

// Checks requests against the cell and the accepted jobs.
class JobIntake {
 public:
  // Limits for active jobs (ExecutiveOptions).
  struct ActiveMax {
    std::size_t jobs;
    std::size_t bytes;
  };
  // `scheduler` and `jobs` outlive this object.
  JobIntake(CellPtr cell, const Scheduler& scheduler, const JobRegister& jobs, ActiveMax active_max)
      : cell_(std::move(cell)), scheduler_(scheduler), jobs_(jobs), active_max_(active_max) {}

  // Joint positions and used keys after all earlier jobs.
  struct Ahead {
    Configuration rest;
    std::unordered_set<std::string> keys;
    std::map<ArmId, TrajectoryPtr> ways_back;  // of arms that have retreated
    std::vector<ArmId> open = {};              // whose position in `rest` is not known yet
    bool begins_anywhere = false;              // jobs need not begin at `rest`
    std::size_t jobs = 0;                      // accepted together with it
    std::size_t bytes = 0;                     // of their trajectories
  };
  [[nodiscard]] Ahead ahead() const;
  // Checks a request completely, before anything is stored. Updates `ahead` for the next request of
  // a batch.
  [[nodiscard]] Result<PreparedJob> prepare(JobRequest request, Ahead& ahead) const;
  [[nodiscard]] Submit submission(PreparedJob prepared) const;
  // Returns the job that brings an arm back after a retreat, before a job of this priority.
  [[nodiscard]] Submit return_of(TrajectoryPtr back, int priority) const;

  void accepted(Ahead ahead) { ways_back_ = std::move(ahead.ways_back); }
  // The arm retreats: remembers where its clients left it, however often it retreats.
  void remember_way_back(ArmId arm, const Trajectory& way);
  void forget_way_back(ArmId arm) { ways_back_.erase(arm); }
  // The server is ending: refuses all further jobs.
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

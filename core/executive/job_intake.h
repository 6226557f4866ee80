#pragma once

#include <cstddef>
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
  std::vector<TrajectoryPtr> alternatives;  // the job's trajectory first; usually the only one
  std::vector<MotionGoal> goals;  // one for each of the trajectories, which are then estimates
  JobTerms terms;
  std::vector<std::string> after;
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

  // The state after all earlier jobs, also of the same batch. Requests are checked against it.
  struct Ahead {
    Configuration rest;
    std::unordered_set<std::string> keys;
    WaysBack ways_back;
    std::vector<ArmId> open = {};  // arms whose position in `rest` is not known yet
    bool begins_anywhere = false;  // jobs need not begin at `rest`
    std::size_t jobs = 0;          // number of earlier jobs of the batch
    std::size_t bytes = 0;         // memory of their trajectories
  };
  [[nodiscard]] Ahead ahead() const;
  // Checks a request completely; stores nothing. Updates `ahead` for the next request of a batch.
  [[nodiscard]] Result<PreparedJob> prepare(JobRequest request, Ahead& ahead) const;
  [[nodiscard]] Submit submission(PreparedJob prepared) const;
  // The server is ending: refuses all further jobs.
  void close() { is_closed_ = true; }

 private:
  [[nodiscard]] std::vector<TrajectoryPtr> read_motions(const JobRequest& request, Ahead& ahead,
                                                        Problems& problems) const;
  // Validates a motion; an implicit start is the position after the earlier jobs.
  [[nodiscard]] Result<TrajectoryPtr> validate_from(const TrajectoryRequest& asked,
                                                    const Ahead& ahead) const;
  // Returns a problem if it is not known where the arm will be.
  [[nodiscard]] std::optional<Problem> unknown_start(ArmId arm, const Ahead& ahead) const;
  // Returns the motion of a goal that moves_gripper_only().
  [[nodiscard]] std::vector<TrajectoryPtr> read_gripper_goal(const JobRequest& request,
                                                             const Ahead& ahead,
                                                             Problems& problems) const;
  [[nodiscard]] std::vector<MotionGoal> read_goals(const JobRequest& request,
                                                   Problems& problems) const;
  [[nodiscard]] std::vector<TrajectoryPtr> estimates_for(const std::vector<MotionGoal>& goals,
                                                         Ahead& ahead) const;
  [[nodiscard]] std::optional<Problem> too_large(std::size_t bytes) const;
  void begin_where_open(const Trajectory& motion, Ahead& ahead) const;
  void find_bad_after(const JobRequest& request, const Ahead& ahead, Problems& problems) const;

  CellPtr cell_;
  const Scheduler& scheduler_;
  const JobRegister& jobs_;
  ActiveMax active_max_;
  bool is_closed_ = false;
};

}  // namespace armloom

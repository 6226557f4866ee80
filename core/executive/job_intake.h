#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/job_register.h"
#include "core/executive/task.h"
#include "core/executive/task_intake.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// The part of a checked request that becomes one step.
struct PreparedMotion {
  std::vector<TrajectoryPtr> alternatives;  // the job's trajectory first; usually the only one
  std::vector<MotionGoal> goals;  // one for each of the trajectories, which are then estimates
};
// A request after all checks.
struct PreparedJob {
  std::string key;  // generated if empty
  std::string name;
  PreparedMotion motion = {};  // unless it is a task
  struct PreparedStep {
    TaskStep step;
    std::optional<PreparedMotion> motion;
  };
  std::vector<PreparedStep> steps = {};  // of a task
  JobTerms terms;
  std::vector<std::string> after;

  [[nodiscard]] std::size_t bytes() const;
};

// Returns the arms that the motions of a task move, ascending.
[[nodiscard]] std::vector<ArmId> arms_of(const std::vector<PreparedJob::PreparedStep>& steps);

[[nodiscard]] std::size_t bytes_of(const std::vector<TrajectoryPtr>& trajectories);

// Checks requests against the cell and the accepted jobs.
class JobIntake {
 public:
  // Limits for active jobs (ExecutiveOptions).
  struct ActiveMax {
    std::size_t jobs;
    std::size_t bytes;
  };
  // The sources that jobs are checked against; they outlive this object.
  struct Seen {
    const Scheduler& scheduler;
    const JobRegister& jobs;
    const TaskBook& tasks;
    std::function<PlanningScenePtr()> scene;  // the present one
  };
  JobIntake(CellPtr cell, const Seen& seen, ActiveMax active_max)
      : cell_(std::move(cell)),
        scheduler_(seen.scheduler),
        jobs_(seen.jobs),
        tasks_(seen.tasks),
        scene_(seen.scene),
        active_max_(active_max) {}

  // The state after all earlier jobs, also of the same batch. Requests are checked against it.
  struct Ahead {
    Configuration rest;
    std::unordered_set<std::string> keys;
    WaysBack ways_back;
    std::vector<ArmId> open = {};       // arms whose position in `rest` is not known yet
    bool begins_anywhere = false;       // jobs need not begin at `rest`
    std::size_t jobs = 0;               // number of earlier jobs of the batch
    std::size_t bytes = 0;              // memory of their trajectories
    std::optional<HandsOf> hands = {};  // after all earlier tasks; set with the first of the batch
  };
  [[nodiscard]] Ahead ahead() const;
  // Returns what hands hold after all earlier jobs.
  [[nodiscard]] HandsOf hands(const Ahead& ahead) const;
  // Checks a request completely; stores nothing. Updates `ahead` for the next request of a batch.
  [[nodiscard]] Result<PreparedJob> prepare(JobRequest request, Ahead& ahead) const;
  // Precondition: no task.
  [[nodiscard]] Submit submission(PreparedJob prepared) const;
  // Returns the submission of a motion of a task. `before`: the motion before it.
  [[nodiscard]] Submit submission(const PreparedJob& prepared, PreparedMotion motion,
                                  std::optional<JobId> before) const;
  // The server is ending: refuses all further jobs.
  void close() { is_closed_ = true; }

 private:
  // Reads a motion, and updates `ahead` if there are no problems.
  [[nodiscard]] PreparedMotion read_motion(const JobRequest& request, Ahead& ahead,
                                           Problems& problems) const;
  [[nodiscard]] std::vector<PreparedJob::PreparedStep> read_steps(const JobRequest& request,
                                                                  Ahead& ahead,
                                                                  Problems& problems) const;
  // Reads a motion of a task.
  [[nodiscard]] PreparedMotion read_step(const StepRequest& asked, const JobRequest& request,
                                         bool is_first, Ahead& ahead, Problems& problems) const;
  [[nodiscard]] std::vector<JobId> ids_of(const std::vector<std::string>& after) const;
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
  // For a job that is no task.
  void find_hands_apart(const JobRequest& request, const PreparedMotion& motion, Ahead& ahead,
                        Problems& problems) const;
  [[nodiscard]] std::optional<Problem> too_large(std::size_t bytes) const;
  void begin_where_open(const Trajectory& motion, Ahead& ahead) const;
  void find_bad_after(const JobRequest& request, const Ahead& ahead, Problems& problems) const;

  CellPtr cell_;
  const Scheduler& scheduler_;
  const JobRegister& jobs_;
  const TaskBook& tasks_;
  std::function<PlanningScenePtr()> scene_;
  ActiveMax active_max_;
  bool is_closed_ = false;
};

}  // namespace armloom

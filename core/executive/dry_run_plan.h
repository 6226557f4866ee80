#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/job_intake.h"
#include "core/executive/simulation.h"
#include "core/executive/task_preview.h"

namespace armloom {

// A view of a step before its submission: a job, or a motion of a job with steps, with the time at
// which it begins if everything goes as planned.
struct Planned {
  std::size_t job;  // its index in the file
  std::string key;
  std::string name;
  TimePoint asked;
  TimePoint starts;
  TrajectoryPtr trajectory = nullptr;        // null if it ends without a motion, ...
  std::optional<JobResultView> result = {};  // ... because of this
  std::vector<std::size_t> after = {};       // indices of those that have to succeed first
  // For a job with steps: the index of the motion, or of the step that cannot be done; the actions
  // before it; what may touch during it.
  std::optional<std::size_t> step = {};
  std::vector<StepRequest> actions = {};
  TouchOf touch = {};

  [[nodiscard]] TimePoint ends() const { return starts + trajectory->duration(); }
  [[nodiscard]] bool moves(ArmId arm) const {
    return trajectory && std::ranges::count(trajectory->arms(), arm) > 0;
  }
};

// The jobs of check_jobs() with their assumed times, taken in the order of the file as one batch.
class DryRunPlan {
 public:
  DryRunPlan(PlanningScenePtr scene, const CellPtr& cell,
             const std::shared_ptr<const Policy>& policy);

  // Problems: those of Executive::submit(), with pointers below "/<index>/job".
  void add(const TimedJob& timed, Problems& problems);

  [[nodiscard]] const std::vector<Planned>& jobs() const { return jobs_; }

 private:
  void follow(std::size_t before, Planned& job);
  void add_steps(std::vector<PreparedJob::PreparedStep> steps, Planned next);
  void choose(const PreparedMotion& motion, const PlanningScenePtr& scene, Planned& job);
  void plan(const std::vector<MotionGoal>& goals, const PlanningScenePtr& scene, Planned& job);
  void take(Planned& job);

  TouchScene scene_;  // as the jobs before leave it
  const Cell& cell_;
  Scheduler scheduler_;  // without jobs, as are the names
  TaskBook tasks_;
  JobRegister none_{scheduler_, tasks_, {}};
  JobIntake intake_;
  JobIntake::Ahead ahead_;
  std::vector<TimePoint> free_at_;
  std::vector<std::string> keys_;
  std::vector<Planned> jobs_;
  std::map<std::string, std::size_t> by_key_;  // of each job the last of jobs_
};

}  // namespace armloom

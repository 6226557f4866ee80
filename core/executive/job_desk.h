#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/task_run.h"

namespace armloom {

// Submission of jobs, commands to them, and their ends. Functions as in executive.h.
class JobDesk : Modules {
 public:
  // All arguments outlive this object. `forget` forgets an ended job in the scheduler.
  JobDesk(const Modules& modules, const JobIntake& intake, TaskRun& tasks,
          std::function<void(JobId)> forget);

  Result<JobView> submit(JobRequest request);
  std::optional<Executive::BatchAnswers> go_on(Executive::Batch& batch);
  std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);

  Result<JobView> cancel(const std::string& key, std::optional<TimePoint> at);
  void roll_back(const std::string& key);
  Result<JobView> amend(const std::string& key, JobAmendment amendment);
  Result<JobView> replan(const std::string& key);
  [[nodiscard]] std::optional<JobView> job(const std::string& key) const;

  // A job has ended: the oldest ended jobs are forgotten.
  void end(JobId ended, TimePoint at);
  // Forgets jobs that were rolled back, once they have ended. Not within a step, whose effects may
  // name the job.
  void forget_rolled_back();

 private:
  Result<std::vector<PreparedJob>> prepare_all(std::vector<JobRequest> requests);
  JobView accept(PreparedJob prepared);
  void enter(Submit submitted, JobLabel label);
  void forget_job(JobId id, const std::string& key);

  const JobIntake& intake_;
  TaskRun& task_run_;
  std::function<void(JobId)> forget_;
  std::vector<JobId> rolled_back_;  // not ended, or not forgotten yet
};

}  // namespace armloom

// Submits jobs and batches, and the jobs that a previous session left.
#include <algorithm>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/batch.h"
#include "core/executive/job_desk.h"

namespace armloom {

JobDesk::JobDesk(const Modules& modules, const JobIntake& intake, TaskRun& tasks,
                 std::function<void(JobId)> forget)
    : Modules(modules), intake_(intake), task_run_(tasks), forget_(std::move(forget)) {}

Result<JobView> JobDesk::submit(JobRequest request) {
  JobIntake::Ahead ahead = intake_.ahead();
  auto prepared = intake_.prepare(std::move(request), ahead);
  if (!prepared) return failure(std::move(prepared.error()));
  return accept(std::move(*prepared));
}

std::optional<Executive::BatchAnswers> JobDesk::go_on(Executive::Batch& batch) {
  if (batch.atomic && !batch.prepared) {
    auto prepared = prepare_all(std::move(batch.requests));
    if (!prepared) return failure(std::move(prepared.error()));
    batch.prepared = std::move(*prepared);
  }
  const std::size_t size = batch.atomic ? batch.prepared->size() : batch.requests.size();
  if (batch.next < size) {
    const std::size_t i = batch.next++;
    batch.answers.push_back(batch.atomic ? Result<JobView>(accept(std::move((*batch.prepared)[i])))
                                         : submit(std::move(batch.requests[i])));
  }
  if (batch.next < size) return std::nullopt;
  return std::move(batch.answers);
}

Result<std::vector<PreparedJob>> JobDesk::prepare_all(std::vector<JobRequest> requests) {
  JobIntake::Ahead ahead = intake_.ahead();
  std::vector<PreparedJob> all;
  Problems problems;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    auto prepared = intake_.prepare(std::move(requests[i]), ahead);
    if (prepared) {
      all.push_back(std::move(*prepared));
    } else {
      add_below("/jobs/" + std::to_string(i), std::move(prepared.error()), problems);
    }
  }
  if (!problems.empty()) return failure(std::move(problems));
  return all;
}

JobView JobDesk::accept(PreparedJob prepared) {
  if (!prepared.steps.empty()) return task_run_.accept_task(std::move(prepared));
  const JobId id = scheduler_.next_job();
  JobLabel label{std::move(prepared.key), std::move(prepared.name)};
  if (label.key.empty()) label.key = jobs_.free_key(id);
  Submit submitted = intake_.submission(std::move(prepared));
  submitted.job = id;
  enter(std::move(submitted), std::move(label));
  return publisher_.view(id);
}

void JobDesk::enter(Submit submitted, JobLabel label) {
  // Alternatives include the trajectory.
  label.bytes = submitted.alternatives.empty() ? submitted.trajectory->bytes()
                                               : bytes_of(submitted.alternatives);
  jobs_.add(submitted.job, std::move(label));
  submitted.start_is_recorded = execution_.starts().has_log();
  step(submitted);
}

std::vector<Result<JobView>> JobDesk::restore(std::vector<RestoredJob> jobs) {
  std::vector<Result<JobView>> answers;
  for (RestoredJob& job : jobs) {
    JobIntake::Ahead ahead = intake_.ahead();
    ahead.begins_anywhere = true;
    auto prepared = intake_.prepare(std::move(job.request), ahead);
    if (!prepared) {
      answers.push_back(failure(std::move(prepared.error())));
      continue;
    }
    JobLabel label{std::move(prepared->key), std::move(prepared->name), job.submitted_at};
    if (!prepared->steps.empty()) {
      task_run_.enter_task(std::move(*prepared), job.id, std::move(label), true);
      answers.push_back(publisher_.view(job.id));
      continue;
    }
    Submit submitted = intake_.submission(std::move(*prepared));
    submitted.job = job.id;
    submitted.is_held_over = true;
    enter(submitted, std::move(label));
    answers.push_back(publisher_.view(job.id));
  }
  return answers;
}

}  // namespace armloom

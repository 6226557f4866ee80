// Handles one job: its view, commands to it, and its end.
#include <utility>
#include <vector>

#include "core/executive/job_desk.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {

Result<JobView> JobDesk::cancel(const std::string& key, std::optional<TimePoint> at) {
  const auto id = jobs_.not_ended(key);
  if (!id) return failure(id.error());
  if (at) {
    clock_.held.hold(key, *at);
  } else if (Task* task = tasks_.find(*id)) {
    task_run_.cancel_task(*task);
  } else {
    step(Cancel{*id});
  }
  return publisher_.view(*id);
}

void JobDesk::roll_back(const std::string& key) {
  const auto id = jobs_.find(key);
  if (!id) return;
  rolled_back_.push_back(*id);
  if (jobs_.not_ended(key)) static_cast<void>(cancel(key, {}));
  forget_rolled_back();
}

void JobDesk::forget_rolled_back() {
  std::erase_if(rolled_back_, [this](JobId id) {
    const Step* step = scheduler_.find(id);
    if (step != nullptr && !is_terminal(jobs_.state(id))) return false;
    const std::string key = jobs_.key(id);
    jobs_.forget(id);
    forget_job(id, key);
    return true;
  });
}

Result<JobView> JobDesk::amend(const std::string& key, JobAmendment amendment) {
  const auto id = jobs_.not_ended(key);
  if (!id) return failure(id.error());
  if (amendment.name) jobs_.rename(*id, *std::move(amendment.name));
  const Task* task = tasks_.find(*id);
  if (task == nullptr) {
    step(Amend{*id, amendment.terms});
  } else {
    for (const JobId motion : task->motions()) step(Amend{motion, amendment.terms});
  }
  return publisher_.view(*id);
}

Result<JobView> JobDesk::replan(const std::string& key) {
  const auto id = jobs_.not_ended(key);
  if (!id) return failure(id.error());
  const JobId motion = tasks_.present_motion(*id);
  if (const auto why = why_not_replanned(*scheduler_.find(motion))) {
    return failure(Problem{ProblemKind::conflict, "no-alternative-path", "",
                           "job \"" + key + "\" cannot be replanned: " + *why, key});
  }
  step(Replan{motion});
  return publisher_.view(*id);
}

void JobDesk::end(JobId ended, TimePoint at) {
  clock_.count.end_of_a_job(at);
  for (const auto& [oldest, key] : jobs_.end(ended)) forget_job(oldest, key);
}

void JobDesk::forget_job(JobId id, const std::string& key) {
  publisher_.forget(id, key);
  const Task* task = tasks_.find(id);
  for (const JobId motion : task == nullptr ? std::vector{id} : task->motions()) {
    forget_(motion);
  }
  tasks_.forget(id);
}

std::optional<JobView> JobDesk::job(const std::string& key) const {
  const auto id = jobs_.find(key);
  if (!id) return std::nullopt;
  JobView view = publisher_.view(*id);
  (void)questions_.tell_check(view);
  return view;
}

}  // namespace armloom

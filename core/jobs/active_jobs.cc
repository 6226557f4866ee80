#include "core/jobs/active_jobs.h"

#include <algorithm>

namespace armloom {

void ActiveJobs::add(const Step& step) {
  const JobId id = step.id.job;
  all_.insert(id);
  if (!step.alternatives.empty()) undecided_.insert(id);
  if (step.goal) ++goals_;
  ++priorities_[step.job->terms.priority];
  for (JobId first : step.job->after) followers_[first].push_back(id);
}

void ActiveJobs::follow(const Step& step) {
  const JobId id = step.id.job;
  const bool is_decided = step.alternatives.empty() || step.in<Queued>() == nullptr;
  is_decided ? (void)undecided_.erase(id) : (void)undecided_.insert(id);
  const auto place = std::ranges::lower_bound(past_queue_, id);
  const bool was_past = place != past_queue_.end() && *place == id;
  const bool is_past = step.state() != JobState::queued && !step.has_ended();
  if (was_past && !is_past) past_queue_.erase(place);
  if (is_past && !was_past) past_queue_.insert(place, id);
}

void ActiveJobs::change_priority(int before, int now) {
  if (--priorities_.at(before) == 0) priorities_.erase(before);
  ++priorities_[now];
}

std::vector<JobId> ActiveJobs::end(const Step& step) {
  all_.erase(step.id.job);
  if (step.goal) --goals_;
  const int priority = step.job->terms.priority;
  if (--priorities_.at(priority) == 0) priorities_.erase(priority);
  auto node = followers_.extract(step.id.job);
  return node.empty() ? std::vector<JobId>{} : std::move(node.mapped());
}

}  // namespace armloom

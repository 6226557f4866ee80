#include "core/executive/queue_lists.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

constexpr std::array kLists{&QueueView::queued, &QueueView::backlog, &QueueView::scheduled,
                            &QueueView::running};

}  // namespace

std::vector<std::string> QueueView::*queue_list_of(JobState state) {
  switch (state) {
    case JobState::queued:
      return &QueueView::queued;
    case JobState::backlogged:
      return &QueueView::backlog;
    case JobState::scheduled:
      return &QueueView::scheduled;
    default:
      return is_terminal(state) ? nullptr : &QueueView::running;
  }
}

std::vector<JobId>& QueueLists::ids(List list) {
  return ids_[static_cast<std::size_t>(std::ranges::find(kLists, list) - kLists.begin())];
}

void QueueLists::put(const JobView& job) {
  const List list = queue_list_of(job.state);
  const auto stood = stands_in_.find(job.id);
  if (stood != stands_in_.end()) {
    if (stood->second == list) return;
    std::vector<JobId>& old = ids(stood->second);
    const auto place = std::ranges::lower_bound(old, job.id) - old.begin();
    (view_.*stood->second).erase((view_.*stood->second).begin() + place);
    old.erase(old.begin() + place);
    stands_in_.erase(stood);
  }
  if (list == nullptr) return;
  std::vector<JobId>& now = ids(list);
  const auto place = std::ranges::lower_bound(now, job.id) - now.begin();
  (view_.*list).insert((view_.*list).begin() + place, job.key);
  now.insert(now.begin() + place, job.id);
  stands_in_.emplace(job.id, list);
}

}  // namespace armloom

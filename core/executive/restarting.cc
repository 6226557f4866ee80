// What a run leaves for the next one, should it end at any time, and what it takes over from the
// one before.
#include <utility>

#include "core/executive/executive_impl.h"

namespace armloom {

// What has not been put down as about to move has no authority until it is.
void Executive::Impl::dispatch(Dispatch dispatch) {
  const Job& job = *scheduler_.find(dispatch.job);
  if (options_.starts != nullptr && !job.system_job) {
    const auto [start, is_first] = starts_.try_emplace(job.id);
    if (is_first) {
      options_.starts->about_to_move(job.id, [this, id = job.id] { start_is_written(id); });
    }
    if (!start->second.is_written) {
      start->second.withheld = std::exchange(dispatch.authority, dispatch.from_progress);
    }
  }
  motions_.dispatch(dispatch, job.trajectory);
}

void Executive::Impl::grant(const Grant& grant) {
  if (!is_withheld(grant.job)) return motions_.grant(grant);
  starts_.at(grant.job).withheld = grant.authority;
}

void Executive::Impl::start_is_written(JobId job) {
  const auto start = starts_.find(job);
  if (start == starts_.end()) return;  // it has ended
  start->second.is_written = true;
  const auto withheld = std::exchange(start->second.withheld, std::nullopt);
  if (withheld && scheduler_.find(job)->in<Moving>() != nullptr) motions_.grant({job, *withheld});
}

// Its arms are told of it and may not leave where they stand: it has not begun.
bool Executive::Impl::is_withheld(JobId job) const {
  const auto start = starts_.find(job);
  return start != starts_.end() && !start->second.is_written;
}

std::vector<Result<JobView>> Executive::Impl::restore(std::vector<RestoredJob> jobs) {
  std::vector<Result<JobView>> answers;
  for (RestoredJob& job : jobs) {
    Ahead ahead = ahead_now();
    ahead.begins_anywhere = true;
    auto prepared = prepare(std::move(job.request), ahead);
    if (!prepared) {
      answers.push_back(failure(std::move(prepared.error())));
      continue;
    }
    Label label{std::move(prepared->key), std::move(prepared->name), job.submitted_at};
    Submit submitted = submission(std::move(*prepared));
    submitted.job = job.id;
    submitted.is_held_over = true;
    enter(submitted, std::move(label));
    answers.push_back(view(*scheduler_.find(job.id)));
  }
  return answers;
}

// Its times of a former run are told as they were.
JobView Executive::Impl::view(const Job& job) const {
  JobView view = view_of(job, *cell_, *this);
  const auto label = labels_.find(job.id);
  if (label != labels_.end() && label->second.submitted_at) {
    view.submitted_at = *label->second.submitted_at;
  }
  return view;
}

}  // namespace armloom

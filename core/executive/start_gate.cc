#include "core/executive/start_gate.h"

#include <utility>

#include "core/executive/executive.h"

namespace armloom {

Dispatch StartGate::pass(Dispatch dispatch, std::function<void()> written) {
  if (log_ == nullptr) return dispatch;
  const auto [start, is_first] = starts_.try_emplace(dispatch.step.job);
  if (is_first) log_->about_to_move(dispatch.step.job, std::move(written));
  if (!start->second.is_written) {
    start->second.withheld = std::exchange(dispatch.authority, dispatch.from_progress);
  }
  return dispatch;
}

bool StartGate::record(JobId job, std::function<void()> written) {
  if (log_ == nullptr) return true;
  const auto [start, is_first] = starts_.try_emplace(job);
  if (is_first) log_->about_to_move(job, std::move(written));
  return start->second.is_written;
}

bool StartGate::keeps(const Grant& grant) {
  if (!withholds(grant.step.job)) return false;
  starts_.at(grant.step.job).withheld = grant.authority;
  return true;
}

std::optional<Duration> StartGate::open(JobId job) {
  const auto start = starts_.find(job);
  if (start == starts_.end()) return std::nullopt;  // it has ended
  start->second.is_written = true;
  return std::exchange(start->second.withheld, std::nullopt);
}

bool StartGate::withholds(JobId job) const {
  const auto start = starts_.find(job);
  return start != starts_.end() && !start->second.is_written;
}

}  // namespace armloom

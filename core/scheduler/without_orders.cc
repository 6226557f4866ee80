#include "core/scheduler/without_orders.h"

#include "core/jobs/phases.h"
#include "core/policies/policy.h"

namespace armloom {

void compare_again(State& state) {
  if (!std::holds_alternative<TimedDiscrete>(state.policy->method())) return;
  const std::vector<JobId> ids = state.jobs.past_queue();
  for (JobId id : ids) {
    Record& record = state.jobs.at(id);
    const bool is_kept = record.job.in<Admitted>() != nullptr && state.arms.stop_of(record.job);
    if (is_kept) withdraw(state, record, {});
  }
  state.recheck_epoch = ++state.version;
}

}  // namespace armloom

#include "core/scheduler/yielding/errands.h"

#include <algorithm>
#include <vector>

#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {
namespace {

bool helps_somebody(const State& state, const Step& own) {
  const JobId helped = own.job->errand.on_behalf_of;
  return helped != own.id.job && state.jobs.is_active(helped);
}

bool returns_from(const Step& own, const std::vector<JobId>& moves) {
  return std::ranges::find_first_of(own.job->after, moves) != own.job->after.end();
}

// Of the first jobs of an arm, while all that is before them is over: where the arm will be when a
// move that stays is done is not where it stands now, so what follows that stays too. Needless ones
// as they are to end: who does not go does not return.
void pass_on(Transitions& state, const ArmQueues::Queue& queue, std::vector<JobId>& needless) {
  const auto is_of_a_client = [&](StepId step) { return !state->jobs.at(step).job->system_job; };
  const auto next = std::ranges::find_if(queue, is_of_a_client);
  if (next == queue.end()) return;
  bool all_end = true;
  for (auto step = queue.begin(); step != next; ++step) {
    const Step& own = state->jobs.at(*step);
    if (own.in<Queued>() == nullptr) return;
    if (returns_from(own, needless)) {
      needless.insert(needless.begin(), own.id.job);
      continue;
    }
    if (!helps_somebody(state, own)) {
      if (all_end && !is_counted_on(state, own)) {
        needless.push_back(own.id.job);
        continue;
      }
      Job job = *own.job;
      job.errand.on_behalf_of = next->job;
      state.jobs().set(own, std::move(job));
    }
    all_end = false;
  }
}

}  // namespace

void pass_errands_on(Transitions& state) {
  std::vector<JobId> needless;
  for (const auto& queue : state->jobs.queues()) pass_on(state, queue, needless);
  for (JobId id : needless) {
    const Step& own = state->jobs.at(id);
    state.end(own, JobState::canceled, Reason::canceled_by_client,
              "the job that it was to help has ended");
  }
}

}  // namespace armloom

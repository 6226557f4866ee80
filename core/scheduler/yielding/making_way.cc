#include "core/scheduler/yielding/making_way.h"

#include <utility>

#include "core/trajectory/joint_line.h"

namespace armloom {

JobId add_own(Transitions& state, YieldMove told, Submit job, std::optional<JobId> before,
              std::optional<JobId> goes) {
  told.job = job.job = state->jobs.next_id();
  job.system_job = true;
  job.terms.priority = state->jobs.at(told.blocked_job).job->terms.priority;
  const Step& helped = state->jobs.at(goes ? *before : told.blocked_job);
  Errand errand{.on_behalf_of = helped.job->errand.on_behalf_of, .before = before};
  if (goes) {
    job.after = {*goes};
    errand.lets_pass = told.blocked_job;
  }
  state.add(job, errand);
  state.announce(told);
  return told.job;
}

void send_aside(Transitions& state, const YieldTrial& move) {
  const Step* next = move.before ? &state->jobs.at(*move.before) : nullptr;
  const bool returns = next != nullptr && !next->goal &&
                       !state->arms.begins_elsewhere(*state->cell, *next->trajectory, move.arm);
  YieldMove told{.arm = move.arm, .blocked_job = move.blocked_job, .in_ring = next != nullptr};
  const JobId goes = add_own(state, told, {.trajectory = move.way}, move.before);
  if (!told.in_ring) state.ways_back().retreat(move.arm, *move.way);
  told.returns = returns;
  if (returns) (void)add_own(state, told, {.trajectory = retraced(*move.way)}, move.before, goes);
  if (next == nullptr || !next->goal) return;
  // A goal begins wherever the arm stands by then.
  state.let_pass(*next, move.blocked_job);
}

void bring_back(Transitions& state, const Submit& job, Configuration rest) {
  auto motions = job.alternatives;
  if (motions.empty()) motions = {job.trajectory};
  for (const TrajectoryPtr& motion : motions) {
    for (TrajectoryPtr& way : state.ways_back().take(*state->cell, *motion, rest)) {
      const YieldMove told{.arm = way->arms().front(), .blocked_job = job.job, .returns = true};
      (void)add_own(state, told, {.trajectory = std::move(way)}, job.job);
    }
  }
}

}  // namespace armloom

#include "core/scheduler/yielding/making_way.h"

#include <utility>

#include "core/jobs/phases.h"
#include "core/trajectory/joint_line.h"

namespace armloom {
namespace {

JobId add_own(State& state, const YieldTrial& move, TrajectoryPtr way, std::optional<JobId> goes) {
  const JobId id = state.jobs.next_id();
  const JobId helped = goes ? *move.before : move.blocked_job;
  const Step& blocked = state.jobs.at(move.blocked_job);
  Submit job{.job = id,
             .trajectory = std::move(way),
             .terms = {.priority = blocked.job->terms.priority},
             .system_job = true};
  Errand errand{.on_behalf_of = state.jobs.at(helped).job->errand.on_behalf_of,
                .before = move.before};
  if (goes) {
    job.after = {*goes};
    errand.lets_pass = move.blocked_job;
  }
  add(state, step_of(state, job, errand));
  state.decided.sent_aside.push_back(
      {id, move.arm, move.blocked_job, move.before.has_value(), goes.has_value()});
  return id;
}

// It gains nothing by the arm's return, where it begins elsewhere anyway.
bool begins_there(const State& state, const Step& next, ArmId arm) {
  return !state.arms.begins_elsewhere(*state.cell, *next.trajectory, arm);
}

}  // namespace

void send_aside(State& state, const YieldTrial& move) {
  Step* next = move.before ? &state.jobs.at(*move.before) : nullptr;
  const bool returns = next != nullptr && !next->goal && begins_there(state, *next, move.arm);
  const JobId goes = add_own(state, move, move.way, std::nullopt);
  if (returns) (void)add_own(state, move, retraced(*move.way), goes);
  if (next == nullptr || !next->goal) return;
  state.jobs.change(*next).errand.lets_pass =
      move.blocked_job;  // a goal begins wherever the arm stands by then
  state.lanes.renew_later();
}

}  // namespace armloom

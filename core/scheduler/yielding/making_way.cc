#include "core/scheduler/yielding/making_way.h"

#include <utility>

#include "core/jobs/phases.h"
#include "core/trajectory/joint_line.h"

namespace armloom {
namespace {

JobId add_own(State& state, const YieldTrial& move, TrajectoryPtr way, std::optional<JobId> goes) {
  const JobId id = state.jobs.next_id();
  const JobId helped = goes ? *move.before : move.blocked_job;
  const Job& blocked = state.jobs.at(move.blocked_job).job;
  Record record =
      record_of(state, {.job = id,
                        .trajectory = std::move(way),
                        .terms = {.priority = blocked.terms.priority,
                                  .backlog_timeout = state.cell->scheduling.backlog_timeout,
                                  .system_job = true}});
  record.errand.on_behalf_of = state.jobs.at(helped).errand.on_behalf_of;
  record.errand.before = move.before;
  if (goes) {
    record.job.terms.after = {*goes};
    record.errand.lets_pass = move.blocked_job;
  }
  add(state, std::move(record));
  state.decided.sent_aside.push_back(
      {id, move.arm, move.blocked_job, move.before.has_value(), goes.has_value()});
  return id;
}

// The arm's next job gains nothing by its return, where it begins elsewhere anyway.
bool begins_there(const State& state, const YieldTrial& move) {
  const Trajectory& next = *state.jobs.at(*move.before).job.trajectory;
  return !state.arms.begins_elsewhere(*state.cell, next, move.arm);
}

}  // namespace

void send_aside(State& state, const YieldTrial& move) {
  const bool returns = move.before && begins_there(state, move);
  const JobId goes = add_own(state, move, move.way, std::nullopt);
  if (returns) (void)add_own(state, move, retraced(*move.way), goes);
}

}  // namespace armloom

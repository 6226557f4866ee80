#include "core/scheduler/yielding/making_way.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/trajectory/joint_line.h"

namespace armloom {
namespace {

bool helps_somebody(const State& state, const Step& own) {
  const JobId helped = own.job->errand.on_behalf_of;
  return helped != own.id.job && state.jobs.active().contains(helped);
}

bool returns_from(const Step& own, const std::vector<JobId>& moves) {
  return std::ranges::find_first_of(own.job->after, moves) != own.job->after.end();
}

// Passes on the server's jobs at the front of an arm's queue. If one of them stays, all after it
// stay too, because they begin where it ends. Adds the others to `needless`, in the order in which
// they must end: a return ends before the retreat that it belongs to.
void pass_on(Transitions& state, const ArmQueues::Queue& queue, std::vector<JobId>& needless) {
  const auto is_of_a_client = [&](StepId step) { return !state->jobs.at(step).job->system_job; };
  const auto next = std::ranges::find_if(queue, is_of_a_client);
  if (next == queue.end()) return;
  bool all_end = true;
  for (const Step& own : state->jobs.of(std::ranges::subrange(queue.begin(), next))) {
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

// Returns true if an earlier motion of the task has brought the arm to where the actions before the
// motion `next` are done.
bool acts_here(Transitions& state, const Step& next, ArmId arm) {
  if (!next.job->awaits_actions || !next.job->task) return false;
  for (auto id = next.job->task->value(); id < next.id.job.value(); ++id) {
    const Step* before = state->jobs.find(JobId{id});
    if (before == nullptr || before->job->task != next.job->task) continue;
    if (std::ranges::count(before->trajectory->arms(), arm) > 0) return true;
  }
  return false;
}

}  // namespace

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
  const bool returns =
      next != nullptr &&
      (acts_here(state, *next, move.arm) ||
       (!next->goal && !state->arms.begins_elsewhere(*state->cell, *next->trajectory, move.arm)));
  YieldMove told{.arm = move.arm, .blocked_job = move.blocked_job, .in_ring = next != nullptr};
  const JobId goes = add_own(state, told, {.trajectory = move.way}, move.before);
  if (!told.in_ring) state.arms().ways_back().retreat(move.arm, *move.way);
  told.returns = returns;
  if (returns) (void)add_own(state, told, {.trajectory = retraced(*move.way)}, move.before, goes);
  if (next == nullptr || !next->goal || returns) return;
  // A goal begins wherever the arm stands by then.
  state.let_pass(*next, move.blocked_job);
}

void pass_errands_on(Transitions& state) {
  std::vector<JobId> needless;
  for (const auto& queue : state->jobs.queues()) pass_on(state, queue, needless);
  for (const Step& own : state->jobs.of(needless)) {
    state.end(own, JobState::canceled, Reason::canceled_by_client,
              "the job that it was to help has ended");
  }
}

void bring_back(Transitions& state, const Submit& job, Configuration rest) {
  auto motions = job.alternatives;
  if (motions.empty()) motions = {job.trajectory};
  for (const TrajectoryPtr& motion : motions) {
    for (TrajectoryPtr& way : state.arms().ways_back().take(*state->cell, *motion, rest)) {
      const YieldMove told{.arm = way->arms().front(), .blocked_job = job.job, .returns = true};
      (void)add_own(state, told, {.trajectory = std::move(way)}, job.job);
    }
  }
}

}  // namespace armloom

#include "core/scheduler/authority.h"

#include <algorithm>
#include <utility>

#include "core/jobs/phases.h"
#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/model/promises.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

void explain_pause(State& state, Record& record) {
  if (auto speed = speed_wait(state, record.job)) {
    return state.jobs.set_wait(record, std::move(*speed));
  }
  const auto held = state.graph.held_back(record.job.step());
  if (held) state.jobs.set_wait(record, wait_for(*held));
}

void pause_at_rest(State& state, Record& record) {
  if (!record.job.has_started() || record.job.pausing()) return;
  std::get<Admitted>(record.job.phase).pause.emplace();
  state.jobs.changed(record);
}

void dispatch_if_ready(State& state, Record& record) {
  Job& job = record.job;
  if (!is_at_head(state, record)) return;
  if (!record.ages_from) record.ages_from = {state.now, state.clock()};
  if (!job.has_started() && state.arms.start_mismatch(*state.cell, *job.trajectory)) {
    return withdraw(state, record, {});
  }
  if (const auto closed = first_closed(state, record, blocks_start)) {
    return state.jobs.set_waits(record, closed->waits.all());
  }
  if (record.asking.is_in_question) return;
  const Duration limit = state.graph.limit(job.step());
  if (limit <= job.progress && job.progress < job.trajectory->duration()) {
    const auto held = state.graph.held_back(job.step());
    if (held && held->arm && !job.has_started()) return withdraw(state, record, {});
    pause_at_rest(state, record);  // stopped on its way: it waits there until it may go on
    explain_pause(state, record);
    return;
  }
  const Duration authority = std::min(limit, job.progress + state.graph.horizon(job.step()));
  state.graph.granted(job.step(), authority);
  if (!job.has_started()) record.off_path = off_path_of(state, record);
  enter(state, record,
        Moving{.overrun_at = overrun_after(state, job),
               .moved_at = state.now,
               .goes_since = state.now,
               .goes_from = job.progress});
  job.times.scheduled_at = state.now;
  state.jobs.set_waits(record, {});
  state.decided.effects.push_back(Dispatch{job.step(), state.now, job.progress, authority});
}

void extend_own_authority(State& state, const Record& record) {
  const Job& job = record.job;
  if (job.in<Moving>() == nullptr) return;
  const Duration limit = state.graph.limit(job.step());
  const Duration authority = std::min(limit, job.progress + state.graph.horizon(job.step()));
  const Duration granted = state.graph.find(job.step())->authority;
  if (authority <= granted || (authority < granted + kGrantStep && authority < limit)) return;
  state.graph.granted(job.step(), authority);
  state.decided.effects.push_back(Grant{job.step(), authority});
}

void go_on(State& state, Record& record) {
  if (record.job.in<Admitted>() != nullptr) {
    dispatch_if_ready(state, record);
  } else {
    extend_own_authority(state, record);
  }
}

}  // namespace

// At share 0 there is no such time.
TimePoint overrun_after(const State& state, const Job& job) {
  const auto& arms = job.trajectory->arms();
  if (state.speed.effective(arms) == 0.0) return TimePoint::max();
  const Duration left = paced(job.trajectory->duration() - job.progress, state.speed.pace(arms));
  return state.now + from_seconds(to_seconds(left) * state.cell->execution.duration_scaling) +
         promises_of(*state.cell, job.trajectory->arms())
             .overrun_margin(state.cell->execution.duration_margin);
}

void dispatch_ready(State& state) {
  const std::vector<JobId> ids = state.jobs.past_queue();
  for (JobId id : ids) {
    Record& record = state.jobs.at(id);
    go_on(state, record);
    if (record.job.pausing()) explain_pause(state, record);
  }
}

void extend_authority(State& state, StepId moved) {
  extend_own_authority(state, state.jobs.at(moved));
  std::vector<StepId> behind;
  for (const Precedence& precedence : state.graph.precedences()) {
    if (precedence.first() == moved &&
        std::ranges::find(behind, precedence.second()) == behind.end())
      behind.push_back(precedence.second());
  }
  for (StepId step : behind) go_on(state, state.jobs.at(step));
}

void see_pauses(State& state, Record& record, Duration progress_before) {
  Job& job = record.job;
  auto* moving = std::get_if<Moving>(&job.phase);
  if (moving == nullptr || !moving->is_under_way) return;
  const Duration limit = state.graph.limit(job.step());
  const bool is_held = limit < job.trajectory->duration();
  if (is_held && job.progress + state.graph.horizon(job.step()) >= limit) {
    moving->overrun_at = overrun_after(state, job);
    moving->moved_at = state.now;
    moving->goes_since = state.now;
    moving->goes_from = job.progress;
  }
  if (job.progress > progress_before) {
    if (!moving->pause) return;
    moving->pause.reset();
    state.jobs.set_waits(record, {});
    state.jobs.changed(record);
    return;
  }
  const bool is_at_limit = is_held && job.progress + kAtLimit >= limit;
  if ((is_at_limit || speed_wait(state, job)) && !moving->pause) {
    moving->pause.emplace();
    explain_pause(state, record);
    state.jobs.changed(record);
  }
}

}  // namespace armloom

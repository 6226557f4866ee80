#include "core/scheduler/authority.h"

#include <algorithm>
#include <utility>

#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/model/promises.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

void explain_pause(Transitions& state, const Step& step) {
  if (auto speed = speed_wait(state, step)) {
    return state.jobs().set_wait(step, std::move(*speed));
  }
  const auto held = state->graph.held_back(step.id);
  if (held) state.jobs().set_wait(step, wait_for(*held));
}

void pause_at_rest(Transitions& state, const Step& step) {
  if (!step.has_started() || step.pausing()) return;
  state.jobs().set(step, Pause{});
}

void dispatch_if_ready(Transitions& state, const Step& step) {
  if (!is_at_head(state, step)) return;
  state.jobs().begin_age(step, {state->now, state->clock()});
  if (!step.has_started() && state->arms.start_mismatch(*state->cell, *step.trajectory)) {
    return state.withdraw(step, {});
  }
  if (const auto closed = first_closed(state, step, blocks_start)) {
    return state.jobs().set_waits(step, closed->waits.all());
  }
  if (step.asking.is_in_question) return;
  const Duration limit = state->graph.limit(step.id);
  if (limit <= step.progress && step.progress < step.trajectory->duration()) {
    const auto held = state->graph.held_back(step.id);
    if (held && held->arm && !step.has_started()) return state.withdraw(step, {});
    pause_at_rest(state, step);  // it was stopped on its path
    explain_pause(state, step);
    return;
  }
  const Duration authority = std::min(limit, step.progress + state->graph.horizon(step.id));
  state.dispatch(step,
                 {.overrun_at = overrun_after(state, step),
                  .moved_at = state->now,
                  .goes_since = state->now,
                  .goes_from = step.progress},
                 off_path_of(state, step), authority);
}

void extend_own_authority(Transitions& state, const Step& step) {
  if (step.in<Moving>() == nullptr || step.asking.is_in_question) return;
  const Duration limit = state->graph.limit(step.id);
  const Duration authority = std::min(limit, step.progress + state->graph.horizon(step.id));
  const Duration granted = state->graph.find(step.id)->authority;
  if (authority <= granted || (authority < granted + kGrantStep && authority < limit)) return;
  state.grant(step, authority);
}

void go_on(Transitions& state, const Step& step) {
  if (step.in<Admitted>() != nullptr) {
    dispatch_if_ready(state, step);
  } else {
    extend_own_authority(state, step);
  }
}

}  // namespace

// Never at a speed override of 0.
TimePoint overrun_after(const State& state, const Step& step) {
  const auto& arms = step.trajectory->arms();
  if (state.speed.effective(arms) == 0.0) return TimePoint::max();
  const Duration left = paced(step.trajectory->duration() - step.progress, state.speed.pace(arms));
  return state.now + from_seconds(to_seconds(left) * state.cell->execution.duration_scaling) +
         promises_of(*state.cell, step.trajectory->arms())
             .overrun_margin(state.cell->execution.duration_margin);
}

void dispatch_ready(Transitions& state) {
  for (const Step& step : state->jobs.past_queue_now()) {
    go_on(state, step);
    if (step.pausing()) explain_pause(state, step);
  }
}

void extend_authority(Transitions& state, StepId moved) {
  extend_own_authority(state, state->jobs.at(moved));
  std::vector<StepId> behind;
  for (const Precedence& precedence : state->graph.precedences()) {
    if (precedence.first() == moved &&
        std::ranges::find(behind, precedence.second()) == behind.end())
      behind.push_back(precedence.second());
  }
  for (StepId step : behind) go_on(state, state->jobs.at(step));
}

void see_pauses(Transitions& state, const Step& step, Duration progress_before) {
  const auto* moving = step.in<Moving>();
  if (moving == nullptr || !moving->is_under_way) return;
  const Duration limit = state->graph.limit(step.id);
  const bool is_held = limit < step.trajectory->duration();
  const bool nears_limit = is_held && step.progress + state->graph.horizon(step.id) >= limit;
  const bool goes_on = step.progress > progress_before;
  if (goes_on && !nears_limit && !moving->pause) return;
  Moving next = *moving;
  if (nears_limit) {
    next.overrun_at = overrun_after(state, step);
    next.moved_at = state->now;
    next.goes_since = state->now;
    next.goes_from = step.progress;
  }
  const bool is_at_limit = is_held && step.progress + kAtLimit >= limit;
  if (goes_on) {
    if (next.pause) state.jobs().set_waits(step, {});
    next.pause.reset();
  } else if ((is_at_limit || speed_wait(state, step)) && !next.pause) {
    next.pause.emplace();
    explain_pause(state, step);
  }
  state.jobs().set(step, next);
}

}  // namespace armloom

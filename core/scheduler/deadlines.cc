#include "core/scheduler/deadlines.h"

#include <algorithm>

#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {
namespace {

// Returns true if the motion's time has passed and it stands still.
bool overruns(Transitions& state, const Step& step) {
  const auto* moving = step.in<Moving>();
  if (moving == nullptr || step.job->awaits_record || state->now < moving->overrun_at) return false;
  Moving next = *moving;
  next.overrun_at = std::max(next.overrun_at, next.moved_at + kStandstill);
  state.jobs().set(step, next);
  return state->now >= next.overrun_at;
}

// Records since when the job rests on its path for an object, the guard, or an arm without a job.
void see_whether_in_vain(Transitions& state, const Step& step) {
  const Pause* pause = step.pause();
  if (pause == nullptr) return;
  const auto set_since = [&](std::optional<TimePoint> since) {
    if (since != pause->in_vain_since) state.jobs().set(step, Pause{since});
  };
  if (any_closed(state, step, is_ended_by_client)) return set_since(std::nullopt);
  const bool held = step.in<Held>() != nullptr;
  if (held && !state->is_judged(step)) return;  // not known yet
  const FoundWaits waits = found_in_the_way(state, step);
  const bool in_vain = std::ranges::any_of(waits.all(), [&](const Wait& wait) {
    return wait.kind == Wait::Kind::object || wait.kind == Wait::Kind::guard ||
           is_idle_arm(state, wait);
  });
  if (!in_vain) set_since(std::nullopt);
  if (in_vain && !pause->in_vain_since) set_since(state->clock());
}

void fail_overdue(Transitions& state, const Step& step) {
  const Duration stood = state->now - step.in<Moving>()->moved_at;
  state.give_up(step, {AfterStop::Then::fail, Reason::overrun,
                       "has not moved for " + seconds_text(stood) +
                           ", and has exceeded the time that it may take "
                           "(duration x duration_scaling + duration_margin_s)"});
}

std::optional<TimePoint> deadline_of(const State& state, const Step& step) {
  if (step.is_replanned_now()) return std::nullopt;  // until the planner answers
  const auto expiry = expiry_of(state, step);
  const auto* moving = step.in<Moving>();
  if (moving == nullptr || step.job->awaits_record) return expiry;
  return expiry ? std::min(moving->overrun_at, *expiry) : moving->overrun_at;
}

}  // namespace

std::optional<TimePoint> expiry_of(const State& state, const Step& step) {
  if (step.is_replanned_now()) return std::nullopt;  // until the planner answers
  if (step.state() == JobState::backlogged)
    return state.speed.when(step.times.backlog_clock + *step.job->terms.backlog_timeout);
  const Pause* pause = step.pause();
  if (pause == nullptr || !pause->in_vain_since) return std::nullopt;
  return state.speed.when(*pause->in_vain_since + *step.job->terms.backlog_timeout);
}

void expire_and_overrun(Transitions& state) {
  for (const Step& step : state->jobs.past_queue_now()) {
    see_whether_in_vain(state, step);
    const auto expiry = expiry_of(state, step);
    const bool is_over = expiry && state->now >= *expiry;
    if (is_over && goes_on_after_timeout(state, step)) continue;
    if (is_over) {
      expire(state, step);
    } else if (overruns(state, step)) {
      fail_overdue(state, step);
    }
  }
}

std::optional<TimePoint> next_deadline(Transitions& state) {
  std::optional<TimePoint> next;
  for (const Step& step : state->jobs.past_queue()) {
    see_whether_in_vain(state, step);
    const auto deadline = deadline_of(state, step);
    if (deadline) next = next ? std::min(*next, *deadline) : deadline;
  }
  return next;
}

}  // namespace armloom

#include "core/scheduler/deadlines.h"

#include <algorithm>

#include "core/jobs/phases.h"
#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {
namespace {

// Its time has passed, and it stands still.
bool overruns(Step& step, TimePoint now) {
  auto* moving = std::get_if<Moving>(&step.phase);
  if (moving == nullptr || step.job->awaits_record || now < moving->overrun_at) return false;
  moving->overrun_at = std::max(moving->overrun_at, moving->moved_at + kStandstill);
  return now >= moving->overrun_at;
}

// Where it is at rest on its way; else null.
template <typename JobType>
auto* pause_of(JobType& job) {
  auto* held = std::get_if<Held>(&job.phase);
  auto* pause = held != nullptr ? &held->pause : nullptr;
  auto* admitted = std::get_if<Admitted>(&job.phase);
  if (admitted != nullptr && admitted->pause) pause = &*admitted->pause;
  auto* moving = std::get_if<Moving>(&job.phase);
  if (moving != nullptr && moving->pause) pause = &*moving->pause;
  return pause;
}

// On its path, where only a job of another arm that has none, or another scene, would let it go on.
void see_whether_in_vain(const State& state, Step& step) {
  Pause* pause = pause_of(step);
  if (pause == nullptr) return;
  if (any_closed(state, step, is_ended_by_client)) return pause->in_vain_since.reset();
  const bool held = step.in<Held>() != nullptr;
  if (held && !state.is_judged(step)) return;  // not known yet
  const FoundWaits waits = found_in_the_way(state, step);
  const bool in_vain = std::ranges::any_of(waits.all(), [&](const Wait& wait) {
    return wait.kind == Wait::Kind::object || is_idle_arm(state, wait);
  });
  if (!in_vain) pause->in_vain_since.reset();
  if (in_vain && !pause->in_vain_since) pause->in_vain_since = state.clock();
}

void fail_overdue(State& state, Step& step) {
  const Duration stood = state.now - step.in<Moving>()->moved_at;
  give_up(state, step,
          {AfterStop::Then::fail, Reason::overrun,
           "has not moved for " + seconds_text(stood) +
               ", and has exceeded the time that it may take "
               "(duration x duration_scaling + duration_margin_s)"});
}

std::optional<TimePoint> deadline_of(const State& state, const Step& step) {
  if (step.is_replanned_now()) return std::nullopt;  // until that is answered
  const auto expiry = expiry_of(state, step);
  const auto* moving = step.in<Moving>();
  if (moving == nullptr || step.job->awaits_record) return expiry;
  return expiry ? std::min(moving->overrun_at, *expiry) : moving->overrun_at;
}

}  // namespace

std::optional<TimePoint> expiry_of(const State& state, const Step& step) {
  if (step.is_replanned_now()) return std::nullopt;  // until that is answered
  if (step.state() == JobState::backlogged)
    return state.speed.when(step.times.backlog_clock + *step.job->terms.backlog_timeout);
  const Pause* pause = pause_of(step);
  if (pause == nullptr || !pause->in_vain_since) return std::nullopt;
  return state.speed.when(*pause->in_vain_since + *step.job->terms.backlog_timeout);
}

void expire_and_overrun(State& state) {
  const std::vector<JobId> ids = state.jobs.past_queue();
  for (JobId id : ids) {
    Step& step = state.jobs.at(id);
    if (step.state() == JobState::backlogged) {
      const auto expiry = expiry_of(state, step);
      if (!expiry || state.now < *expiry || goes_on_after_timeout(state, step)) continue;
      end(state, step, JobState::expired, Reason::backlog_timeout,
          "waited " + seconds_text(*step.job->terms.backlog_timeout) + " in the backlog");
      continue;
    }
    see_whether_in_vain(state, step);
    const auto expiry = expiry_of(state, step);
    const bool in_vain = expiry && state.now >= *expiry;
    if (in_vain && goes_on_after_timeout(state, step)) continue;
    if (in_vain) {
      give_up(state, step,
              {AfterStop::Then::fail, Reason::backlog_timeout,
               "waited " + seconds_text(*step.job->terms.backlog_timeout) + " on its path"});
    } else if (overruns(step, state.now)) {
      fail_overdue(state, step);
    }
  }
}

std::optional<TimePoint> next_deadline(State& state) {
  std::optional<TimePoint> next;
  for (JobId id : state.jobs.past_queue()) {
    Step& step = state.jobs.at(id);
    see_whether_in_vain(state, step);
    const auto deadline = deadline_of(state, step);
    if (deadline) next = next ? std::min(*next, *deadline) : deadline;
  }
  return next;
}

}  // namespace armloom

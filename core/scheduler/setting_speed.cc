#include "core/scheduler/setting_speed.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/jobs/standing.h"
#include "core/jobs/timeline.h"
#include "core/scheduler/authority.h"
#include "core/scheduler/weighing.h"

namespace armloom {
namespace {

void renew_starts(Transitions& state) {
  for (const PredictedLeg& leg : predicted_timeline(state, state->now).legs) {
    const Step& step = state->jobs.at(leg.step);
    const bool is_to_start = step.in<Admitted>() != nullptr && !step.has_started();
    if (is_to_start && leg.starts) state.jobs().schedule(step, leg.starts);
  }
}

}  // namespace

void renew_clocks(Transitions& state, const Step& step, bool rested) {
  const auto* moving = step.in<Moving>();
  if (moving == nullptr) return;
  Moving next = *moving;
  next.overrun_at = overrun_after(state, step);
  next.goes_since = state->now;
  next.goes_from = step.progress;
  if (rested) next.moved_at = state->now;
  state.jobs().set(step, next);
}

namespace {

void speed_has_changed(Transitions& state, const SpeedOverride& before) {
  for (const Step& step : state->jobs.past_queue_now()) {
    const auto& arms = step.trajectory->arms();
    if (before.effective(arms) == state->speed.effective(arms)) continue;
    renew_clocks(state, step, before.effective(arms) == 0.0);
  }
  std::vector<ArmId> all;
  for (std::uint32_t arm = 0; arm < state->cell->arms.size(); ++arm) all.emplace_back(arm);
  explain_again(state, all);
  prepare_choice(state, {});
  renew_starts(state);
  compare_again(state);
}

}  // namespace

void set_speed(Transitions& state, const SetSpeed& input) {
  if (!SpeedOverride::is_valid(input.share)) throw std::invalid_argument("SetSpeed: wrong share");
  const SpeedOverride before = state->speed;
  state.set_speed(input);
  speed_has_changed(state, before);
}

void set_brake(Transitions& state, const SetBrake& input) {
  const SpeedOverride before = state->speed;
  state.set_brake(input);
  speed_has_changed(state, before);
}

void explain_again(Transitions& state, const std::vector<ArmId>& arms) {
  std::set<StepId> steps;
  for (const ArmId arm : arms) {
    steps.insert(state->jobs.queues()[arm].begin(), state->jobs.queues()[arm].end());
  }
  for (const Step& step : state->jobs.of(steps)) {
    const auto is_of_operator = [](const Wait& wait) {
      return wait.kind == Wait::Kind::stop || wait.kind == Wait::Kind::speed ||
             wait.kind == Wait::Kind::holding;
    };
    const auto wait = operator_wait(state, step);
    const bool waited = std::ranges::any_of(step.waits_on, is_of_operator);
    if (waited && wait) state.jobs().set_wait(step, *wait);
    if (waited && !wait) state.jobs().set_waits(step, {});
    if (waited || wait) state.jobs().explain(step);
  }
}

}  // namespace armloom

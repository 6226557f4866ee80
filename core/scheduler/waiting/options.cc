#include "core/scheduler/waiting/options.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "core/policies/policy.h"
#include "core/scheduler/waiting/capacity.h"
#include "core/scheduler/waiting/gates.h"
#include "core/trajectory/joints_elsewhere.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

ArmId arm_of(const Trajectory& trajectory) { return trajectory.arms().front(); }

// Returns true if the step moves one arm, and returns it to its start.
bool is_loop(const Step& step) { return step.leg.arms.size() == 1 && step.leg.from == step.leg.to; }

// A job with several candidate arms has no position to exchange. A condition that blocks the start
// of the job, but not of all jobs of its arm, ties it to its position.
bool may_change_places(const State& state, const Step& step) {
  const auto ties = [](const Gate& gate) { return blocks_start(gate) && !gate.of_its_arm; };
  return step.job->terms.reorderable && step.in<Queued>() != nullptr && step.alternatives.empty() &&
         is_loop(step) && !any_closed(state, step, ties);
}

bool is_overtaken_no_more(const State& state, const Step& step) {
  return step.overtaken_at && state.clock() - *step.overtaken_at >= state.cell->scheduling.aging;
}

std::vector<Option> in_any_order(const State& state, const Step& turn) {
  std::vector<Option> options{{turn.id.job}};
  if (!may_change_places(state, turn) || is_overtaken_no_more(state, turn)) return options;
  const auto& queue = state.jobs.queues()[turn.leg.arms.front()];
  const auto own = std::ranges::find(queue, turn.id);
  for (auto step = own + 1; step != queue.end(); ++step) {
    const Step& other = state.jobs.at(*step);
    const bool fits = may_change_places(state, other) &&
                      other.job->terms.priority == turn.job->terms.priority &&
                      other.leg.from == turn.leg.from;
    if (!fits || options.size() >= kOptionsMax) break;
    options.push_back({step->job});
  }
  return options;
}

// When the job could go on the arm of this trajectory: now, within the policy's horizon; later,
// after the jobs before it; or never, because these leave the arm elsewhere.
enum class When { now, later, never };
When when_on(const State& state, const Step& step, const Trajectory& trajectory) {
  const ArmId arm = arm_of(trajectory);
  Configuration at = state.arms.rest();
  std::size_t admitted = 0;
  bool is_next = true;
  const std::size_t place = place_on(state, step, arm);
  for (StepId id : state.jobs.queues()[arm] | std::views::take(place)) {
    if (id == step.id) continue;
    const Step& other = state.jobs.at(id);
    if (other.is_admitted()) ++admitted;
    is_next = is_next && other.is_admitted();
    follow_to_end(at, *state.cell, arm, *other.trajectory);
  }
  if (!joints_elsewhere(*state.cell, trajectory, at).empty()) return When::never;
  return is_next && admitted < state.policy->lookahead.horizon ? When::now : When::later;
}

std::vector<Option> on_several_arms(const State& state, const Step& step) {
  const auto& alternatives = step.alternatives;
  std::vector<Option> options;
  for (std::size_t k = 0; k < alternatives.size(); ++k) {
    if (!step.may_go_by(k)) continue;
    const Trajectory& trajectory = *alternatives[k];
    const When when = when_on(state, step, trajectory);
    const ArmId arm = arm_of(trajectory);
    if (when == When::never || state.arms.is_stopped(arm)) continue;
    if (is_in(arm, state.around.shared_holds)) continue;
    const bool is_home = alternatives[k] == step.trajectory;
    options.insert(is_home ? options.begin() : options.end(),
                   Option{step.id.job, k, when == When::now});
  }
  return options;
}

std::size_t alternative_now(const Step& step) {
  const auto now = std::ranges::find(step.alternatives, step.trajectory);
  return static_cast<std::size_t>(now - step.alternatives.begin());
}

// Returns true if the job waits and no sequence contains it with its present arm.
bool is_shut(Transitions& state, const Step& step) {
  return step.in<Queued>() != nullptr &&
         !state.lanes().has_place(step.id, state->jobs, state->arms);
}

// Gives the job an arm with which a sequence contains it. Returns false if there is none. Then it
// restores the arm, and what is known about it, which would otherwise be asked again forever.
bool take_open_alternative(Transitions& state, const Step& step) {
  const std::size_t had = alternative_now(step);
  const std::uint64_t motion = step.leg.motion;
  Lanes lanes = state->lanes;
  for (const Option& option : on_several_arms(state, step)) {
    if (option.alternative == had) continue;
    take_alternative(state, step, option.alternative);
    if (!is_shut(state, step)) return true;
  }
  take_alternative(state, step, had);
  state.restore(step, motion, std::move(lanes));
  return false;
}

// Gives the job another arm for good. `why`: the reason against its present arm.
bool takes_arm_that_remains(Transitions& state, const Step& step, const char* why) {
  const ArmId had = arm_of(*step.trajectory);
  if (!take_open_alternative(state, step)) return false;
  state.jobs().set(step, Choice{.arms = {arm_of(*step.trajectory)}, .without = {{had, why}}});
  state.jobs().decide_arm(step);
  return true;
}

}  // namespace

bool others_may_take_its_turn(const State& state, const Step& turn) {
  return in_any_order(state, turn).size() > 1;
}

std::size_t place_on(const State& state, const Step& step, ArmId arm) {
  const auto goes_before = [&](StepId id) {
    const Step& other = state.jobs.at(id);
    if (id == step.id) return false;
    // An errand counts with the turn of the job that it is for.
    const auto& next = other.job->errand.before;
    if (other.in<Queued>() == nullptr || next == step.id.job) return true;
    const Step* whose = next ? state.jobs.find(*next) : nullptr;
    return (whose != nullptr ? whose->job->turn : other.job->turn) < step.job->turn;
  };
  const auto& queue = state.jobs.queues()[arm];
  const auto last = std::find_if(queue.rbegin(), queue.rend(), goes_before);
  return static_cast<std::size_t>(queue.rend() - last);
}

void take_alternative(Transitions& state, const Step& step, std::size_t which) {
  const TrajectoryPtr trajectory = step.alternatives[which];
  const auto& queue = state->jobs.queues()[arm_of(*trajectory)];
  const auto now = std::ranges::find(queue, step.id) - queue.begin();
  auto place = static_cast<std::ptrdiff_t>(place_on(state, step, arm_of(*trajectory)));
  if (step.trajectory == trajectory) {
    // Jobs that were admitted before this one may wait again. Then the older turn goes first.
    if (now < place) --place;
    if (now == place || step.in<Queued>() == nullptr) return;
  }
  state.take_alternative(step, which, static_cast<std::size_t>(place));
}

bool take_arms_that_remain(Transitions& state, const std::vector<StepId>& go) {
  if (state->jobs.active().undecided().empty()) return false;
  if (state.lanes().after(go, state->jobs, state->arms).all) return false;
  bool any = false;
  for (JobId id : first_undecided(state)) {
    const Step& step = state->jobs.at(id);
    if (!is_shut(state, step)) continue;
    any |= takes_arm_that_remains(state, step, "other arms come to rest in its path");
  }
  return any;
}

std::vector<JobId> first_undecided(const State& state) {
  auto first =
      state.jobs.active().undecided() | std::views::take(kUndecidedMax) | std::views::common;
  return {first.begin(), first.end()};
}

bool leaves_by_other_arm(Transitions& state, const WaitCycle& ring) {
  for (const Step& step : state->jobs.of(ring)) {
    if (step.in<Queued>() == nullptr || step.alternatives.empty()) continue;
    if (!takes_arm_that_remains(state, step, "the job would wait forever in a deadlock cycle"))
      continue;
    state.jobs().set(step, Judgement{});
    return true;
  }
  return false;
}

std::vector<Option> options_of(const State& state, JobId turn) {
  const Step& step = state.jobs.at(turn);
  const auto& alternatives = step.alternatives;
  const bool waits = step.in<Queued>() != nullptr;
  if (waits && alternatives.empty()) return in_any_order(state, step);
  auto options = waits ? on_several_arms(state, step) : std::vector<Option>{};
  if (!options.empty()) return options;
  return {{turn, alternative_now(step)}};
}

bool has_turn_on_some_arm(const State& state, const Step& step) {
  if (step.in<Queued>() == nullptr || step.alternatives.empty()) return false;
  return std::ranges::any_of(on_several_arms(state, step), &Option::goes_now);
}

void give_turn(Transitions& state, const std::vector<Option>& options, std::size_t first) {
  const Step& taker = state->jobs.at(options[first].job);
  if (!taker.alternatives.empty()) {
    return take_alternative(state, taker, options[first].alternative);
  }
  if (options.size() == 1) return;
  std::vector<JobId> jobs{options[first].job};
  for (const Option& option : options) {
    if (option.job != jobs.front()) jobs.push_back(option.job);
  }
  state.put_in_order(jobs);
  give_place_to_first(state, jobs);
}

void reopen_turn(Transitions& state, const Step& added) {
  if (!may_change_places(state, added)) return;
  const auto& queue = state->jobs.queues()[added.leg.arms.front()];
  const auto waits = [&](StepId step) { return state->jobs.at(step).is_waiting(); };
  const Step& first = state->jobs.at(*std::ranges::find_if(queue, waits));
  const bool is_queued = first.in<Queued>() != nullptr;
  if (is_queued && options_of(state, first.id.job).size() > 1) {
    state.jobs().set(first, Judgement{});
  }
}

bool stand(const State& state, const std::vector<Option>& options) {
  return std::ranges::all_of(options, [&](const Option& option) {
    return state.jobs.active().contains(option.job) &&
           state.jobs.at(option.job).in<Queued>() != nullptr;
  });
}

bool begins_on_other_arm(Transitions& state, const Step& step) {
  for (std::size_t k = 0; k < step.alternatives.size(); ++k) {
    if (step.in<Queued>() == nullptr) return false;
    if (when_on(state, step, *step.alternatives[k]) == When::never) continue;
    take_alternative(state, step, k);
    return true;
  }
  return false;
}

}  // namespace armloom

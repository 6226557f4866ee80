#include "core/scheduler/waiting/options.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "core/policies/policy.h"
#include "core/scheduler/waiting/capacity.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

ArmId arm_of(const Trajectory& trajectory) { return trajectory.arms().front(); }

// One arm, which it leaves where it was.
bool is_loop(const Record& record) {
  return record.leg.arms.size() == 1 && record.leg.from == record.leg.to;
}

// A job with several candidate arms has no place yet that it could change. What blocks the start of
// one job, but not of all jobs of its arm, ties the job to its place.
bool may_change_places(const State& state, const Record& record) {
  const auto ties = [](const Gate& gate) { return blocks_start(gate) && !gate.of_its_arm; };
  return record.job.terms.reorderable && record.job.in<Queued>() != nullptr &&
         record.job.alternatives.empty() && is_loop(record) && !any_closed(state, record, ties);
}

bool is_overtaken_no_more(const State& state, const Record& record) {
  return record.overtaken_at &&
         state.clock() - *record.overtaken_at >= state.cell->scheduling.aging;
}

std::vector<Option> in_any_order(const State& state, const Record& turn) {
  std::vector<Option> options{{turn.job.id}};
  if (!may_change_places(state, turn) || is_overtaken_no_more(state, turn)) return options;
  const auto& queue = state.jobs.queues()[turn.leg.arms.front()];
  const auto own = std::ranges::find(queue, turn.job.step());
  for (auto step = own + 1; step != queue.end(); ++step) {
    const Record& other = state.jobs.at(*step);
    const bool fits = may_change_places(state, other) &&
                      other.job.terms.priority == turn.job.terms.priority &&
                      other.leg.from == turn.leg.from;
    if (!fits || options.size() >= kOptionsMax) break;
    options.push_back({step->job});
  }
  return options;
}

// When it could go on the arm of this trajectory: when those have ended that are admitted there, as
// far as the policy looks ahead; when those have gone that came before it; or not, as these lead
// elsewhere.
enum class When { now, later, never };
When when_on(const State& state, const Record& record, const Trajectory& trajectory) {
  const ArmId arm = arm_of(trajectory);
  const Place* leads_to = nullptr;
  std::size_t admitted = 0;
  bool is_next = true;
  const std::size_t place = place_on(state, record, arm);
  for (StepId step : state.jobs.queues()[arm] | std::views::take(place)) {
    if (step == record.job.step()) continue;
    const Record& other = state.jobs.at(step);
    if (other.job.is_admitted()) ++admitted;
    is_next = is_next && other.job.is_admitted();
    for (std::size_t i = 0; i < other.leg.arms.size(); ++i) {
      if (other.leg.arms[i] == arm) leads_to = other.leg.to[i].get();
    }
  }
  const bool begins = leads_to != nullptr
                          ? begins_at(*state.cell, trajectory, *leads_to)
                          : !state.arms.begins_elsewhere(*state.cell, trajectory).has_value();
  if (!begins) return When::never;
  return is_next && admitted < state.policy->lookahead.horizon ? When::now : When::later;
}

std::vector<Option> on_several_arms(const State& state, const Record& record) {
  const auto& alternatives = record.job.alternatives;
  std::vector<Option> options;
  for (std::size_t k = 0; k < alternatives.size(); ++k) {
    if (!record.job.may_go_by(k)) continue;
    const Trajectory& trajectory = *alternatives[k];
    const When when = when_on(state, record, trajectory);
    if (when == When::never || state.arms.is_stopped(arm_of(trajectory))) continue;
    const bool is_home = alternatives[k] == record.job.trajectory;
    options.insert(is_home ? options.begin() : options.end(),
                   Option{record.job.id, k, when == When::now});
  }
  return options;
}

std::size_t alternative_now(const Job& job) {
  const auto now = std::ranges::find(job.alternatives, job.trajectory);
  return static_cast<std::size_t>(now - job.alternatives.begin());
}

// It waits, and is in no sequence by the arm that it has.
bool is_shut(State& state, const Record& record) {
  return record.job.in<Queued>() != nullptr &&
         !state.lanes.has_place(record.job.step(), state.jobs, state.arms);
}

// Takes one by which it is not shut. Returns false if there is none: it keeps what it had, and what
// is known of that, which would else be asked again, for ever.
bool take_open_alternative(State& state, Record& record) {
  const std::size_t had = alternative_now(record.job);
  const std::uint64_t motion = record.leg.motion;
  Lanes lanes = state.lanes;
  for (const Option& option : on_several_arms(state, record)) {
    if (option.alternative == had) continue;
    take_alternative(state, record, option.alternative);
    if (!is_shut(state, record)) return true;
  }
  take_alternative(state, record, had);
  record.leg.motion = motion;
  state.lanes = std::move(lanes);
  state.lanes.renew_later();
  return false;
}

// It keeps that arm: `why` it cannot do without on the one that it has.
bool takes_arm_that_remains(State& state, Record& record, const char* why) {
  const ArmId had = arm_of(*record.job.trajectory);
  if (!take_open_alternative(state, record)) return false;
  record.job.choice = Choice{.arms = {arm_of(*record.job.trajectory)}, .without = {{had, why}}};
  state.jobs.decide_arm(record);
  return true;
}

}  // namespace

bool others_may_take_its_turn(const State& state, const Record& turn) {
  return in_any_order(state, turn).size() > 1;
}

std::size_t place_on(const State& state, const Record& record, ArmId arm) {
  const auto goes_before = [&](StepId step) {
    const Record& other = state.jobs.at(step);
    if (step == record.job.step()) return false;
    // An errand counts with the turn of the job that it is for.
    const auto& next = other.errand.before;
    if (other.job.in<Queued>() == nullptr || next == record.job.id) return true;
    const Record* whose = next ? state.jobs.find(*next) : nullptr;
    return (whose != nullptr ? whose->turn : other.turn) < record.turn;
  };
  const auto& queue = state.jobs.queues()[arm];
  const auto last = std::find_if(queue.rbegin(), queue.rend(), goes_before);
  return static_cast<std::size_t>(queue.rend() - last);
}

void take_alternative(State& state, Record& record, std::size_t which) {
  const TrajectoryPtr trajectory = record.job.alternatives[which];
  const auto& queue = state.jobs.queues()[arm_of(*trajectory)];
  const auto now = std::ranges::find(queue, record.job.step()) - queue.begin();
  auto place = static_cast<std::ptrdiff_t>(place_on(state, record, arm_of(*trajectory)));
  if (record.job.trajectory == trajectory) {
    // Jobs that were admitted before this one may wait again: then the older turn goes first.
    if (now < place) --place;
    if (now == place || record.job.in<Queued>() == nullptr) return;
  }
  if (record.job.goal) record.job.goal->taken = which;
  WaitingLeg leg = state.arms.leg_of(*state.cell, record.job.step(), *trajectory);
  state.jobs.take(record, trajectory, std::move(leg), static_cast<std::size_t>(place));
  state.lanes.renew_later();
}

bool take_arms_that_remain(State& state, const std::vector<StepId>& go) {
  if (state.jobs.undecided().empty()) return false;
  if (state.lanes.after(go, state.jobs, state.arms).all) return false;
  bool any = false;
  for (JobId id : first_undecided(state)) {
    Record& record = state.jobs.at(id);
    if (!is_shut(state, record)) continue;
    any |= takes_arm_that_remains(state, record, "other arms come to rest in its path");
  }
  if (any) ++state.version;
  return any;
}

std::vector<JobId> first_undecided(const State& state) {
  auto first = state.jobs.undecided() | std::views::take(kUndecidedMax) | std::views::common;
  return {first.begin(), first.end()};
}

bool leaves_by_other_arm(State& state, const WaitCycle& ring) {
  for (JobId id : ring) {
    Record& record = state.jobs.at(id);
    auto* queued = std::get_if<Queued>(&record.job.phase);
    if (queued == nullptr || record.job.alternatives.empty()) continue;
    if (!takes_arm_that_remains(state, record, "the job would wait forever in a deadlock cycle"))
      continue;
    queued->judgement = {};
    ++state.version;
    return true;
  }
  return false;
}

std::vector<Option> options_of(State& state, JobId turn) {
  const Record& record = state.jobs.at(turn);
  const auto& alternatives = record.job.alternatives;
  const bool waits = record.job.in<Queued>() != nullptr;
  if (waits && alternatives.empty()) return in_any_order(state, record);
  auto options = waits ? on_several_arms(state, record) : std::vector<Option>{};
  if (!options.empty()) return options;
  return {{turn, alternative_now(record.job)}};
}

bool has_turn_on_some_arm(const State& state, const Record& record) {
  if (record.job.in<Queued>() == nullptr || record.job.alternatives.empty()) return false;
  return std::ranges::any_of(on_several_arms(state, record), &Option::goes_now);
}

void give_turn(State& state, const std::vector<Option>& options, std::size_t first) {
  Record& taker = state.jobs.at(options[first].job);
  if (!taker.job.alternatives.empty()) {
    return take_alternative(state, taker, options[first].alternative);
  }
  if (options.size() == 1) return;
  std::vector<JobId> jobs{options[first].job};
  for (const Option& option : options) {
    if (option.job != jobs.front()) jobs.push_back(option.job);
  }
  state.jobs.put_in_order(jobs);
  state.lanes.renew_later();
  give_place_to_first(state, jobs);
}

void reopen_turn(State& state, const Record& added) {
  if (!may_change_places(state, added)) return;
  const auto& queue = state.jobs.queues()[added.leg.arms.front()];
  const auto waits = [&](StepId step) { return state.jobs.at(step).job.is_waiting(); };
  Record& first = state.jobs.at(*std::ranges::find_if(queue, waits));
  auto* queued = std::get_if<Queued>(&first.job.phase);
  if (queued != nullptr && options_of(state, first.job.id).size() > 1) queued->judgement = {};
}

bool stand(const State& state, const std::vector<Option>& options) {
  return std::ranges::all_of(options, [&](const Option& option) {
    return state.jobs.is_active(option.job) &&
           state.jobs.at(option.job).job.in<Queued>() != nullptr;
  });
}

bool begins_on_other_arm(State& state, Record& record) {
  for (std::size_t k = 0; k < record.job.alternatives.size(); ++k) {
    if (record.job.in<Queued>() == nullptr) return false;
    if (when_on(state, record, *record.job.alternatives[k]) == When::never) continue;
    take_alternative(state, record, k);
    return true;
  }
  return false;
}

}  // namespace armloom

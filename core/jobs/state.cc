#include "core/jobs/state.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <type_traits>
#include <utility>

namespace armloom {

// The rules reach a state only through the transitions of its owners.
static_assert(std::is_same_v<decltype(std::declval<StateWriter&>().operator->()), const State*>);
static_assert(!std::is_convertible_v<StateWriter&, State&>);
static_assert(!std::is_assignable_v<State&, State> && !std::is_assignable_v<JobBook&, JobBook> &&
              !std::is_assignable_v<ArmRests&, ArmRests> && !std::is_assignable_v<Lanes&, Lanes>);

std::vector<Effect> StateWriter::take_effects() {
  if (added_.empty() && !state_.jobs.updates_.has_changed()) return std::exchange(effects_, {});
  std::vector<Effect> result;
  const std::vector<YieldMove> added = std::exchange(added_, {});
  for (const YieldMove& move : added) result.emplace_back(move);
  std::set<JobId> changed = state_.jobs.updates_.take_changed();
  for (const YieldMove& move : added) {  // they are known before others wait for them
    if (changed.erase(move.job) != 0) result.emplace_back(JobChanged{move.job});
  }
  for (JobId job : changed) result.emplace_back(JobChanged{job});
  std::ranges::move(std::exchange(effects_, {}), std::back_inserter(result));
  return result;
}

void StateWriter::change_scene(std::vector<SharedHold> shared_holds) {
  ++state_.changes_;
  state_.around.scene_since = state_.version();
  state_.around.refused_plans = {};
  state_.around.shared_holds = std::move(shared_holds);
  state_.lanes.forget_passages();
}

void StateWriter::change_policy(std::shared_ptr<const Policy> policy) {
  state_.policy = std::move(policy);
  state_.round = {};
  ++state_.changes_;
}

void StateWriter::set_speed(const SetSpeed& input) {
  const double before = input.arm ? state_.speed.arm(*input.arm) : state_.speed.cell();
  if (input.share == before) return;
  state_.speed.set(input.arm, input.share, state_.now);
  state_.expected.spoil();
  ++state_.changes_;
}

void StateWriter::set_brake(const SetBrake& input) {
  if (input.share == state_.speed.brake(input.arm)) return;
  state_.speed.set_brake(input.arm, input.share);
  state_.expected.spoil();
  ++state_.changes_;
}

void StateWriter::set_signal(const SignalChanged& input) {
  const SignalChanged before = std::exchange(state_.around.signals[input.signal], input);
  for (const Step& step : state_.jobs.of(state_.jobs.active())) {
    const auto& wanted = step.job->terms.start_when;
    if (!wanted || wanted->signal != input.signal) continue;
    state_.jobs.explain(step);
    if ((before.value == wanted->value) != (input.value == wanted->value)) ++state_.changes_;
  }
}

void StateWriter::locate(const Located& input) {
  state_.arms.locate(*state_.cell, input.arm, input.position);
  state_.lanes.renew_later();
}

void StateWriter::renew_orders(const PassingOrders& orders) {
  const std::vector<CoordinatedMotion> nobody;
  const std::size_t motions = state_.graph.motions().size();
  // None are found if admitted motions wait for each other.
  const bool found = orders.blockers.empty() && orders.prediction.ends.size() == motions;
  if (found) state_.graph.admit(nobody, orders);
  state_.expected.renew(found ? state_.graph.motions() : nobody, orders.prediction, state_.now);
}

}  // namespace armloom

#include "core/scheduler/ways/detour.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/scheduler/waiting/choosing.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/ways/path_requests.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

constexpr TimePoint kNever = TimePoint::max();

bool may_go_round(const Step& step) {
  return step.goal && !step.has_open_arm() && step.in<Queued>() != nullptr &&
         !step.is_unplanned() && !step.is_replanned_now() && !step.goal->way().goal.straight;
}

// When it would be there.
TimePoint arrival(const State& state, const PassingOrders& orders) {
  const bool goes =
      orders.blockers.empty() && orders.prediction.ends.size() > state.graph.motions().size();
  return goes ? state.now + orders.prediction.ends.back() : kNever;
}

// If nobody met it on its way.
TimePoint soonest(const State& state, const Step& step, const PassingOrders& orders) {
  return state.now + free_at(state, step.goal->way().goal.arm, orders.prediction) +
         state.time_for(*step.trajectory);
}

// From when to when of its own time the other motion is in the way there.
std::pair<Duration, Duration> holds(const ConflictRegion& region) {
  const auto from = std::ranges::min_element(region.boxes, {}, &ProgressBox::from_b)->from_b;
  const auto to = std::ranges::max_element(region.boxes, {}, &ProgressBox::to_b)->to_b;
  return {from, to};
}

// Where each of the others is half-way through the longest time for which it is in the way; all
// else where it rests, or will.
Configuration places_held(const State& state, const Step& step,
                          const std::vector<PairRegions>& regions) {
  Configuration at = state.arms.rest();
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    const Trajectory& trajectory = *state.jobs.at(motion.step).trajectory;
    set_joints(at, trajectory, trajectory.goal());
  }
  Eigen::VectorXd held;
  for (const PairRegions& pair : regions) {
    const auto* other = std::get_if<StepId>(&pair.b);
    if (other == nullptr || pair.regions.empty()) continue;
    const Trajectory& trajectory = *state.jobs.at(*other).trajectory;
    Duration from{}, to{};
    for (const ConflictRegion& region : pair.regions) {
      const auto [begins, ends] = holds(region);
      if (ends - begins >= to - from) std::tie(from, to) = std::pair(begins, ends);
    }
    trajectory.sample_positions(from + (to - from) / 2, held);
    set_joints(at, trajectory, held);
  }
  set_joints(at, *step.trajectory, step.trajectory->start());
  return at;
}

// Stores the detour and requests the next path for it.
void ask(Transitions& state, const Step& step, Detour detour) {
  const JobGoal& goal = *step.goal;
  PlanQuestion question{
      .goal = {.arm = goal.way().goal.arm,
               .to = Eigen::VectorXd(step.trajectory->goal()),
               .speed = goal.way().goal.speed},
      .at = detour.request.beside,
      .seed = step.id.job.value() + 1U + static_cast<std::uint64_t>(detour.request.tries),
      .budget = kDetourBudget};
  detour.request = send(state, step, ForDetour{}, std::move(detour.request), std::move(question));
  state.jobs().set(step, std::move(detour));
}

// Whether another one is worth the question.
bool goes_on(const Detour& detour) {
  return detour.arrives > detour.soon_enough && detour.request.tries < kDetoursMax;
}

// Of those that were weighed. Whether that is another one than it had.
bool go_by_best(Transitions& state, const Step& step, Detour detour) {
  const TrajectoryPtr best = detour.best;
  detour.is_weighed = false;
  state.jobs().set(step, std::move(detour));
  if (!best || step.trajectory == best) return false;
  state.go_by(step, best);
  return true;
}

// It has been judged by another way. Whether it is to be judged once more: by a further one, or by
// the best of them.
bool rate(Transitions& state, const Step& step, Detour detour, TimePoint arrives) {
  if (arrives != kNever && arrives + Choosing::kWorthwhile < detour.arrives) {
    detour.best = step.trajectory;
    detour.is_taken = true;
    if (detour.arrives != kNever) detour.saves += detour.arrives - arrives;
    detour.arrives = arrives;
  }
  const bool asks_on = goes_on(detour);
  // Meanwhile it has the best of them: what others leave it has to be a way that it may go.
  const bool is_another = go_by_best(state, step, std::move(detour));
  if (asks_on) ask(state, step, *step.goal->detour);
  return asks_on || is_another;
}

}  // namespace

bool weighs_detour(Transitions& state, const Step& step, const std::vector<PairRegions>& regions,
                   const PassingOrders& orders) {
  if (!may_go_round(step)) return false;
  const auto& had = step.goal->detour;
  const TimePoint arrives = arrival(state, orders);
  if (had && had->is_weighed) return rate(state, step, *had, arrives);
  const TimePoint soon_enough = soonest(state, step, orders) + kWaitWorthADetour;
  if (arrives <= soon_enough || (had && had->request.tries >= kDetoursMax)) return false;
  Configuration beside = places_held(state, step, regions);
  const bool is_as_tried =
      had && had->request.asked_at >= state->around.scene_since && had->request.beside == beside;
  if (is_as_tried) return false;
  Detour detour = had.value_or(Detour{});
  detour.request.beside = std::move(beside);
  detour.best = step.trajectory;
  detour.arrives = arrives;
  detour.soon_enough = soon_enough;
  ask(state, step, std::move(detour));
  return true;
}

bool gives_detour_up(Transitions& state, const Step& step) {
  if (!may_go_round(step) || !step.goal->detour) return false;
  Detour detour = *step.goal->detour;
  if (!std::exchange(detour.is_taken, false)) {
    return go_by_best(state, step, std::move(detour));
  }
  detour.best = nullptr;
  detour.is_weighed = false;
  detour.saves = {};
  state.jobs().set(step, std::move(detour));
  forget_plan(state, step);
  return true;
}

void take_detour(Transitions& state, const Step& step, const PlanMade& answer) {
  Detour detour = *step.goal->detour;
  if (!may_go_round(step)) return;
  const bool fits = answer.trajectory && detour.best &&
                    detour.request.asked_at >= state->around.scene_since &&
                    answer.trajectory->start().isApprox(detour.best->start());
  const bool is_sooner = fits && state->now + state->time_for(*answer.trajectory) < detour.arrives;
  // One that takes longer than the best says nothing of the next one; that there is none does.
  if (fits && !is_sooner && goes_on(detour)) return ask(state, step, std::move(detour));
  if (!is_sooner) return (void)go_by_best(state, step, std::move(detour));
  detour.is_weighed = true;
  state.jobs().set(step, std::move(detour));
  state.go_by(step, answer.trajectory);
}

}  // namespace armloom

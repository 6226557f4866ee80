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

// Returns the job's arrival with these orders; kNever if it cannot go.
TimePoint arrival(const State& state, const PassingOrders& orders) {
  const bool goes =
      orders.blockers.empty() && orders.prediction.ends.size() > state.graph.motions().size();
  return goes ? state.now + orders.prediction.ends.back() : kNever;
}

// Returns the arrival if no other motion were in the way.
TimePoint soonest(const State& state, const Step& step, const PassingOrders& orders) {
  return state.now + free_at(state, step.goal->way().goal.arm, orders.prediction) +
         state.time_for(*step.trajectory);
}

// Returns from when to when, in its own time, the other motion is in the way.
std::pair<Duration, Duration> holds(const ConflictRegion& region) {
  const auto from = std::ranges::min_element(region.boxes, {}, &ProgressBox::from_b)->from_b;
  const auto to = std::ranges::max_element(region.boxes, {}, &ProgressBox::to_b)->to_b;
  return {from, to};
}

// Returns the positions to avoid: other motions in the middle of their longest conflict with the
// job, and all other arms where they rest or will rest.
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

// Returns true if another detour is worth a request.
bool goes_on(const Detour& detour) {
  return detour.arrives > detour.soon_enough && detour.request.tries < kDetoursMax;
}

// Gives the job the best path so far. Returns true if its path changed.
bool go_by_best(Transitions& state, const Step& step, Detour detour) {
  const TrajectoryPtr best = detour.best;
  detour.is_weighed = false;
  state.jobs().set(step, std::move(detour));
  if (!best || step.trajectory == best) return false;
  state.go_by(step, best);
  return true;
}

// Rates the path with which the job was checked. Then requests a further detour, or gives the job
// its best path. Returns true if the job must be checked again.
bool rate(Transitions& state, const Step& step, Detour detour, TimePoint arrives) {
  if (arrives != kNever && arrives + Choosing::kWorthwhile < detour.arrives) {
    detour.best = step.trajectory;
    detour.is_taken = true;
    if (detour.arrives != kNever) detour.saves += detour.arrives - arrives;
    detour.arrives = arrives;
  }
  const bool asks_on = goes_on(detour);
  // Until the next plan arrives, the job has its best path, because other jobs rely on it.
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
  // A detour that is too long says nothing about the next one. If there is no detour, no further
  // one is requested.
  if (fits && !is_sooner && goes_on(detour)) return ask(state, step, std::move(detour));
  if (!is_sooner) return (void)go_by_best(state, step, std::move(detour));
  detour.is_weighed = true;
  state.jobs().set(step, std::move(detour));
  state.go_by(step, answer.trajectory);
}

}  // namespace armloom

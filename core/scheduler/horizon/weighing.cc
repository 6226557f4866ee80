#include "core/scheduler/horizon/weighing.h"

#include <utility>

#include "core/scheduler/policy.h"

namespace armloom {
namespace {

constexpr Duration kEvery = std::chrono::milliseconds(250);
// An arm that sets out or brakes may be seen so long in one place.
constexpr Duration kStandsFrom = std::chrono::milliseconds(250);

// Since when its arms have stood for no reason of ours.
std::optional<TimePoint> stands_since(const Job& job) {
  if (const auto* moving = job.in<Moving>()) {
    return moving->pause ? std::nullopt : std::optional(moving->moved_at);
  }
  const bool stopped = job.in<Braking>() != nullptr || job.in<Held>() != nullptr;
  return stopped ? std::optional(job.progress_seen_at) : std::nullopt;
}

// What stands though nothing of ours holds it counts as standing for as long again.
void note_what_stands(State& state) {
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    const auto since = stands_since(state.jobs.at(motion.job).job);
    const Duration stood = since ? state.now - *since : Duration{};
    state.graph.set_stands_for(motion.job, stood < kStandsFrom ? Duration{} : stood);
  }
}

}  // namespace

void prepare_choice(State& state, const std::vector<JobId>& jobs) {
  std::vector<Duration> work_behind = state.jobs.work();
  std::vector<JobId> in_front = jobs;
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    const auto& ages_from = state.jobs.at(motion.job).ages_from;
    if (ages_from && state.now - *ages_from >= state.cell->scheduling.aging) {
      state.graph.keep_place(motion.job);
    }
    in_front.push_back(motion.job);
  }
  for (JobId id : in_front) {
    const Trajectory& trajectory = *state.jobs.at(id).job.trajectory;
    for (ArmId arm : trajectory.arms()) work_behind[arm.index()] -= trajectory.duration();
  }
  state.graph.set_work_behind(std::move(work_behind));
  if (state.policy->weighs_again()) note_what_stands(state);
}

void weigh_again(State& state) {
  if (!state.policy->weighs_again()) return;
  if (!state.expected.is_missed(state.graph.motions(), state.now)) return;
  prepare_choice(state, {});
  const std::vector<CoordinatedMotion> nobody;
  const std::vector<PairRegions> nothing;
  const PassingOrders orders = state.policy->decide(state.graph.question(nobody, nothing));
  if (orders.blockers.empty()) state.graph.admit(nobody, orders);
  state.expected.renew(state.graph.motions(), orders.prediction, state.now);
}

std::optional<TimePoint> weighs_next(const State& state) {
  if (!state.policy->weighs_again() || state.graph.motions().empty()) return std::nullopt;
  return TimePoint((state.now.time_since_epoch() / kEvery + 1) * kEvery);
}

}  // namespace armloom

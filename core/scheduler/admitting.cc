#include "core/scheduler/admitting.h"

#include <algorithm>
#include <set>

#include "core/model/promises.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

// Counts, for the first job of each arm, the admitted jobs that overtake it after it has waited for
// `aging_s`.
void note_overtaken(Transitions& state, const std::vector<StepId>& admitted) {
  std::set<StepId> firsts;  // a step of several arms is the first of several queues
  for (const auto& queue : state->jobs.queues()) {
    if (!queue.empty()) firsts.insert(queue.front());
  }
  for (const StepId first : firsts) {
    const Step& step = state->jobs.at(first);
    const bool waits_long = step.in<Queued>() != nullptr && state->has_aged(step);
    if (!waits_long) continue;
    const auto overtaking = std::ranges::count_if(admitted, [&](StepId id) {
      const Step& other = state->jobs.at(id);
      return id != first && !other.job->system_job && step.job->turn < other.job->turn;
    });
    if (overtaking == 0) continue;
    const std::size_t before = step.starvation ? step.starvation->overtaken_by : 0;
    state.jobs().set(step,
                     Starvation{step.ages_from->at, before + static_cast<std::size_t>(overtaking)});
  }
}

}  // namespace

void note_free(Transitions& state, const Step& step) {
  Asking asking = step.asking;
  asking.found_free_at = state->version();
  asking.is_in_question = false;
  state.jobs().set(step, asking);
}

void admit(Transitions& state, const std::vector<StepId>& steps,
           std::vector<CoordinatedMotion> candidates, const PassingOrders& orders) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Trajectory& trajectory = *state->jobs.at(steps[i]).trajectory;
    candidates[i].horizon = from_seconds(stopping_reach_s(*state->cell, trajectory)) +
                            state->cell->monitor.reaction +
                            promises_of(*state->cell, trajectory.arms()).free_run();
  }
  state.admit(steps, candidates, orders);
  for (StepId id : steps) note_free(state, state->jobs.at(id));
  note_overtaken(state, steps);
}

}  // namespace armloom

#include "core/scheduler/admitting.h"

#include <algorithm>
#include <set>

#include "core/jobs/phases.h"
#include "core/model/promises.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

// Counts, for the first job of each arm, the admitted jobs that overtake it after it has waited for
// `aging_s`.
void note_overtaken(State& state, const std::vector<StepId>& admitted) {
  std::set<StepId> firsts;  // a step of several arms is the first of several queues
  for (const auto& queue : state.jobs.queues()) {
    if (!queue.empty()) firsts.insert(queue.front());
  }
  for (const StepId first : firsts) {
    Step& step = state.jobs.at(first);
    const bool waits_long = step.in<Queued>() != nullptr && state.has_aged(step);
    if (!waits_long) continue;
    const auto overtaking = std::ranges::count_if(admitted, [&](StepId id) {
      const Step& other = state.jobs.at(id);
      return id != first && !other.job->system_job && step.job->turn < other.job->turn;
    });
    if (overtaking == 0) continue;
    const std::size_t before = step.starvation ? step.starvation->overtaken_by : 0;
    step.starvation = Starvation{step.ages_from->at, before + static_cast<std::size_t>(overtaking)};
    state.jobs.changed(step);
  }
}

}  // namespace

void note_free(State& state, Step& step) {
  step.asking.found_free_at = state.version();
  step.asking.is_in_question = false;
}

void admit(State& state, const std::vector<StepId>& steps,
           std::vector<CoordinatedMotion> candidates, const PassingOrders& orders) {
  state.lanes.admitted(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Trajectory& trajectory = *state.jobs.at(steps[i]).trajectory;
    candidates[i].horizon = from_seconds(stopping_reach_s(*state.cell, trajectory)) +
                            state.cell->monitor.reaction +
                            promises_of(*state.cell, trajectory.arms()).free_run();
  }
  state.graph.admit(candidates, orders);
  const std::size_t before = state.graph.motions().size() - steps.size();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Step& step = state.jobs.at(steps[i]);
    if (step.has_open_arm()) state.jobs.decide_arm(step);
    enter(state, step, Admitted{});
    step.times.scheduled_at = state.now + orders.prediction.begins[before + i];
    step.waits_on.clear();
    step.starvation.reset();
    step.asking.effort = 1;
    state.jobs.changed(step);
  }
  for (StepId id : steps) note_free(state, state.jobs.at(id));
  state.expected.renew(state.graph.motions(), orders.prediction, state.now);
  note_overtaken(state, steps);
}

}  // namespace armloom

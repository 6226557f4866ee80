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
    Record& record = state.jobs.at(first);
    const bool waits_long = record.job.in<Queued>() != nullptr && state.has_aged(record);
    if (!waits_long) continue;
    const auto overtaking = std::ranges::count_if(admitted, [&](StepId step) {
      const Record& other = state.jobs.at(step);
      return step != first && !other.job.system_job && record.turn < other.turn;
    });
    if (overtaking == 0) continue;
    const std::size_t before = record.job.starvation ? record.job.starvation->overtaken_by : 0;
    record.job.starvation =
        Starvation{record.ages_from->at, before + static_cast<std::size_t>(overtaking)};
    state.jobs.changed(record);
  }
}

}  // namespace

void note_free(State& state, Record& record) {
  record.asking.found_free_at = state.version;
  record.asking.is_in_question = false;
}

void admit(State& state, const std::vector<StepId>& steps,
           std::vector<CoordinatedMotion> candidates, const PassingOrders& orders) {
  state.lanes.admitted(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Trajectory& trajectory = *state.jobs.at(steps[i]).job.trajectory;
    candidates[i].horizon = from_seconds(stopping_reach_s(*state.cell, trajectory)) +
                            state.cell->monitor.reaction +
                            promises_of(*state.cell, trajectory.arms()).free_run();
  }
  state.graph.admit(candidates, orders);
  ++state.version;
  const std::size_t before = state.graph.motions().size() - steps.size();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    Record& record = state.jobs.at(steps[i]);
    if (record.job.has_open_arm()) state.jobs.decide_arm(record);
    enter(state, record, Admitted{});
    record.job.times.scheduled_at = state.now + orders.prediction.begins[before + i];
    record.job.waits_on.clear();
    record.job.starvation.reset();
    note_free(state, record);
    record.asking.effort = 1;
    state.jobs.changed(record);
  }
  state.expected.renew(state.graph.motions(), orders.prediction, state.now);
  note_overtaken(state, steps);
}

}  // namespace armloom

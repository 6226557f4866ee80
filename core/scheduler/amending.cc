#include "core/scheduler/amending.h"

#include <optional>
#include <utility>

namespace armloom {
namespace {

void set_priority(State& state, Step& step, int priority) {
  state.jobs.set_priority(step, priority);
  const StepId id = step.id;
  if (state.graph.holds(id)) state.graph.set_priority(id, priority);
}

}  // namespace

void amend(State& state, const Amend& input) {
  Step* step = state.jobs.find(input.job);
  if (step == nullptr || step->has_ended()) return;
  AmendedTerms terms = input.terms;
  const auto priority = std::exchange(terms.priority, std::nullopt);  // not the job's alone
  apply(terms, state.jobs.change(*step).terms);
  state.jobs.changed(*step);
  if (!priority || *priority == step->job->terms.priority) return;
  set_priority(state, *step, *priority);
  for (JobId id : state.jobs.active()) {
    Step& other = state.jobs.at(id);
    const bool is_on_its_behalf =
        id != step->id.job && other.job->errand.on_behalf_of == step->id.job;
    if (is_on_its_behalf) set_priority(state, other, *priority);
  }
  state.expected.spoil();
}

}  // namespace armloom

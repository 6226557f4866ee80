#include "core/scheduler/amending.h"

namespace armloom {
void amend(Transitions& state, const Amend& input) {
  const Step* step = state->jobs.find(input.job);
  if (step == nullptr || step->has_ended()) return;
  const int before = step->job->terms.priority;
  state.amend(*step, input.terms);
  const int priority = step->job->terms.priority;
  if (priority == before) return;
  for (JobId id : state->jobs.active()) {
    const Step& other = state->jobs.at(id);
    const bool is_on_its_behalf =
        id != step->id.job && other.job->errand.on_behalf_of == step->id.job;
    if (is_on_its_behalf) state.amend(other, {.priority = priority});
  }
}

}  // namespace armloom

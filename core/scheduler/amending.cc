#include "core/scheduler/amending.h"

#include <optional>
#include <utility>

namespace armloom {
namespace {

void set_priority(State& state, Record& record, int priority) {
  state.jobs.set_priority(record, priority);
  const StepId step = record.job.step();
  if (state.graph.holds(step)) state.graph.set_priority(step, priority);
}

}  // namespace

void amend(State& state, const Amend& input) {
  Record* record = state.jobs.find(input.job);
  if (record == nullptr || record->job.has_ended()) return;
  Job& job = record->job;
  AmendedTerms terms = input.terms;
  const auto priority = std::exchange(terms.priority, std::nullopt);  // not the job's alone
  apply(terms, job.terms);
  state.jobs.changed(*record);
  if (!priority || *priority == job.terms.priority) return;
  set_priority(state, *record, *priority);
  for (JobId id : state.jobs.active()) {
    Record& other = state.jobs.at(id);
    const bool is_on_its_behalf = id != job.id && other.errand.on_behalf_of == job.id;
    if (is_on_its_behalf) set_priority(state, other, *priority);
  }
  ++state.version;
  state.expected.spoil();
}

}  // namespace armloom

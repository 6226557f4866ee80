#include "core/scheduler/amending.h"

namespace armloom {
namespace {

void set_priority(State& state, Record& record, int priority) {
  state.jobs.set_priority(record, priority);
  if (state.graph.holds(record.job.id)) state.graph.set_priority(record.job.id, priority);
}

}  // namespace

void amend(State& state, const Amend& input) {
  Record* record = state.jobs.find(input.job);
  if (record == nullptr || record->job.has_ended()) return;
  Job& job = record->job;
  if (input.backlog_timeout) job.terms.backlog_timeout = *input.backlog_timeout;
  if (input.replans_on_timeout) job.terms.replans_on_timeout = *input.replans_on_timeout;
  state.jobs.changed(*record);
  if (!input.priority || *input.priority == job.terms.priority) return;
  set_priority(state, *record, *input.priority);
  for (JobId id : state.jobs.active()) {
    Record& other = state.jobs.at(id);
    const bool is_on_its_behalf = id != job.id && other.errand.on_behalf_of == job.id;
    if (is_on_its_behalf) set_priority(state, other, *input.priority);
  }
  ++state.version;
  state.expected.spoil();
}

}  // namespace armloom

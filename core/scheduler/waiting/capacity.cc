#include "core/scheduler/waiting/capacity.h"

#include <algorithm>

#include "core/jobs/standing.h"
#include "core/policies/policy.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

// Returns true if the job waits for other jobs, or for an arm that only another job moves away.
bool stands_in_vain(const State& state, const Record& record) {
  const auto ended_by_jobs = [](const Gate& gate) {
    return gate.ended_by != EndedBy::planner && gate.ended_by != EndedBy::client;
  };
  return record.job.is_waiting() ? any_closed(state, record, ended_by_jobs)
                                 : held_where_it_stands(state, record).has_value();
}

}  // namespace

bool has_rounds(const State& state) { return state.policy->capacity == Capacity::rounds; }

std::optional<JobId> place_taken_by(const State& state, const Record& record) {
  switch (state.policy->capacity) {
    case Capacity::any:
      return std::nullopt;
    case Capacity::one_job:
      for (const Job* other : occupying(state.jobs)) {
        if (other != &record.job) return other->id;  // else it is held on its path
      }
      return std::nullopt;
    case Capacity::rounds:
      const auto& jobs = state.round.jobs;
      if (jobs.empty() || jobs.contains(record.job.id)) return std::nullopt;
      return *jobs.begin();
  }
  return std::nullopt;
}

void renew_round(State& state) {
  if (!has_rounds(state)) return;
  Round& round = state.round;
  const JobBook& book = state.jobs;
  const auto blocks_place = [](const Gate& gate) { return gate.blocks >= Blocks::place; };
  std::erase_if(round.jobs, [&](JobId id) { return !book.is_active(id); });
  for (const auto& queue : book.queues()) {
    for (const StepId step : queue) {
      const auto& before = book.at(step).errand.before;
      if (!before) break;
      if (round.jobs.contains(*before)) round.jobs.insert(step.job);
    }
  }
  const bool stuck =
      std::ranges::all_of(round.jobs, [&](JobId id) { return stands_in_vain(state, book.at(id)); });
  if (round.jobs.empty()) round.has_begun = false;
  for (JobId id : round.jobs) round.has_begun |= book.at(id).job.has_started();
  if (round.has_begun && !stuck) return;
  for (const auto& queue : book.queues()) {
    if (queue.empty()) continue;
    const Record& record = book.at(queue.front());
    const bool goes = record.job.is_waiting() && !record.job.is_unplanned() &&
                      !any_closed(state, record, blocks_place);
    if (goes) round.jobs.insert(record.job.id);
  }
}

void give_place_to_first(State& state, const std::vector<JobId>& jobs) {
  auto& round = state.round.jobs;
  for (JobId id : jobs) {
    if (round.erase(id) > 0) round.insert(jobs.front());
  }
}

}  // namespace armloom

#include "core/scheduler/waiting/capacity.h"

#include <algorithm>
#include <utility>

#include "core/jobs/standing.h"
#include "core/policies/policy.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

// Returns true if the job waits for other jobs, or for an arm that only another job moves away.
bool stands_in_vain(const State& state, const Step& step) {
  const auto ended_by_jobs = [](const Gate& gate) {
    return gate.ended_by != EndedBy::planner && !is_ended_by_client(gate);
  };
  return step.is_waiting() ? any_closed(state, step, ended_by_jobs)
                           : held_where_it_stands(state, step).has_value();
}

}  // namespace

bool has_rounds(const State& state) { return state.policy->capacity == Capacity::rounds; }

std::optional<JobId> place_taken_by(const State& state, const Step& step) {
  switch (state.policy->capacity) {
    case Capacity::any:
      return std::nullopt;
    case Capacity::one_job:
      for (const Step* other : occupying(state.jobs)) {
        if (other != &step) return other->id.job;  // else it is held on its path
      }
      return std::nullopt;
    case Capacity::rounds:
      const auto& jobs = state.round.jobs;
      if (jobs.empty() || jobs.contains(step.id.job)) return std::nullopt;
      return *jobs.begin();
  }
  return std::nullopt;
}

void renew_round(Transitions& state) {
  if (!has_rounds(state)) return;
  Round round = state->round;
  const JobBook& book = state->jobs;
  const auto blocks_place = [](const Gate& gate) { return gate.blocks >= Blocks::place; };
  std::erase_if(round.jobs, [&](JobId id) { return !book.active().contains(id); });
  for (const auto& queue : book.queues()) {
    for (const Step& step : book.of(queue)) {
      const auto& before = step.job->errand.before;
      if (!before) break;
      if (round.jobs.contains(*before)) round.jobs.insert(step.id.job);
    }
  }
  if (round.jobs.empty()) round.has_begun = false;
  for (JobId id : round.jobs) round.has_begun |= book.at(id).has_started();
  state.set_round(round);
  const bool stuck =
      std::ranges::all_of(round.jobs, [&](JobId id) { return stands_in_vain(state, book.at(id)); });
  if (round.has_begun && !stuck) return;
  for (const Step& step : book.heads()) {
    const bool is_planned = !step.is_unplanned() || step.stands_in() != nullptr;
    const bool goes = step.is_waiting() && is_planned && !any_closed(state, step, blocks_place);
    if (goes) round.jobs.insert(step.id.job);
  }
  state.set_round(std::move(round));
}

void give_place_to_first(Transitions& state, const std::vector<JobId>& jobs) {
  Round round = state->round;
  for (JobId id : jobs) {
    if (round.jobs.erase(id) > 0) round.jobs.insert(jobs.front());
  }
  state.set_round(std::move(round));
}

}  // namespace armloom

#include "core/scheduler/waiting/gates.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/jobs/standing.h"
#include "core/policies/policy.h"
#include "core/scheduler/waiting/capacity.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/ways/goals.h"

namespace armloom {
namespace {

using Closed = std::optional<FoundWaits>;
using Edges = std::vector<WaitsForEdge>;

Closed order(const Look& look, JobId first, std::optional<ArmId> arm = {}) {
  if (!look.tells) return FoundWaits();
  return FoundWaits(Wait{.kind = Wait::Kind::predecessor, .job = first, .arm = arm});
}

// Returns true if the job is the first of the arm. With turns also if it is one of the arm's first
// jobs, as many as the policy looks ahead, and all before it are admitted. If another job could
// take its turn, it is not admitted ahead, so that this choice stays open.
bool is_next(const Look& look, const Step& step, ArmId arm) {
  const State& state = look.state;
  const auto& queue = state.jobs.queues()[arm];
  if (!queue.empty() && queue.front() == step.id) return true;
  const bool ahead = look.turns != nullptr && step.is_waiting() && state.lanes.follows_on(step.id);
  const std::size_t horizon = ahead ? state.policy->lookahead.horizon : 1;
  for (std::size_t place = 0; place < std::min(horizon, queue.size()); ++place) {
    if (queue[place] == step.id) {
      return !holds_one_ahead(state, step) && !others_may_take_its_turn(state, step);
    }
    if (!state.jobs.at(queue[place]).is_admitted()) return false;
  }
  return false;
}

Closed behind(const Look& look, const Step& step) {
  for (ArmId arm : step.trajectory->arms()) {
    if (is_next(look, step, arm)) continue;
    return order(look, look.state.jobs.queues().before(step, arm)->job, arm);
  }
  return std::nullopt;
}

// Adds an edge from each job to the job before it, in the queues of the step's arms: from the step
// down to the first step that `told` contains. The queue's first job may move.
void add_behind(const State& state, const Step& step, Edges& edges,
                std::set<std::pair<ArmId, StepId>>& told) {
  for (ArmId arm : step.trajectory->arms()) {
    const auto& queue = state.jobs.queues()[arm];
    if (told.contains({arm, step.id})) continue;
    for (auto id = std::ranges::find(queue, step.id); id != queue.begin(); --id) {
      const StepId before = *std::prev(id);
      if (!told.emplace(arm, *id).second || !stands(state, state.jobs.at(before))) break;
      edges.push_back({id->job, before.job});
    }
  }
}

Closed open_arm(const Look& look, const Step& step) {
  const auto first = may_go_first(look.state, step);
  return first ? order(look, *first) : std::nullopt;
}

void add_open_arm(const State& state, const Step& step, Edges& edges) {
  if (!state.jobs.queues().is_first(step)) return;  // by then its arms rest elsewhere
  if (const auto first = may_go_first(state, step)) edges.push_back({step.id.job, *first});
}

Closed after(const Look& look, const Step& step) {
  if (step.job->after.empty()) return std::nullopt;
  return order(look, step.job->after.front());
}

void add_after(const State& state, const Step& step, Edges& edges) {
  for (JobId before : step.job->after) {
    if (stands(state, state.jobs.at(before))) edges.push_back({step.id.job, before});
  }
}

Closed plan(const Look&, const Step& step) {
  const bool is_unplanned = step.is_unplanned() && step.stands_in() == nullptr;
  const bool is_asked = is_unplanned || step.is_replanned_now() || step.is_detour_asked() ||
                        step.approaches.are_in_question();
  if (!is_asked) return std::nullopt;
  return FoundWaits(Wait{.kind = Wait::Kind::plan});
}

Closed lets_pass(const Look& look, const Step& step) {
  if (!lets_another_pass(look.state.jobs, step)) return std::nullopt;
  return order(look, *step.job->errand.lets_pass);
}

void add_lets_pass(const State& state, const Step& step, Edges& edges) {
  if (lets_another_pass(state.jobs, step))
    edges.push_back({step.id.job, *step.job->errand.lets_pass});
}

Closed stop(const Look& look, const Step& step) {
  auto wait = operator_wait(look.state, step);
  if (!wait) return std::nullopt;
  return FoundWaits(std::move(*wait));
}

Closed signal(const Look& look, const Step& step) {
  auto wait = signal_wait(look.state, step);
  if (!wait) return std::nullopt;
  return FoundWaits(std::move(*wait));
}

Closed actions(const Look&, const Step& step) {
  if (!step.job->awaits_actions) return std::nullopt;
  return FoundWaits(Wait{.kind = Wait::Kind::action});
}

Closed place(const Look& look, const Step& step) {
  const auto taken_by = place_taken_by(look.state, step);
  if (!taken_by) return std::nullopt;
  return FoundWaits(Wait{.kind = Wait::Kind::capacity, .job = *taken_by});
}

// Rounds add no edge: a round whose jobs all stand lets other jobs in, so its places close no
// cycle.
void add_place(const State& state, const Step& step, Edges& edges) {
  if (!step.is_waiting() || has_rounds(state)) return;
  const auto taken_by = place_taken_by(state, step);
  if (taken_by && stands(state, state.jobs.at(*taken_by))) {
    edges.push_back({step.id.job, *taken_by});
  }
}

Closed conflict(const Look& look, const Step& step) {
  if (!step.is_waiting()) return std::nullopt;
  if (!look.state.is_judged(step)) return std::nullopt;
  return FoundWaits(step.judgement().found);
}

// Returns true if the job moves, or could move next although no other job moves first.
bool may_go(const State& state, const Step& step) {
  const auto stays = [](const Gate& gate) {
    return gate.ended_by != EndedBy::planner && gate.ended_by != EndedBy::choice;
  };
  if (!stands(state, step)) return true;
  return step.is_waiting() && !any_closed(state, step, stays);
}

// Returns true if the job's plan goes through other arms and another job may still move. Its path
// is then planned again (ways/goals.h), so its waits are not final.
bool may_have_another_way(const State& state, const Step& step) {
  if (step.in<Queued>() == nullptr || !step.goal || !step.goal->way().goes_through) return false;
  return std::ranges::any_of(state.jobs.active(), [&](JobId id) {
    return id != step.id.job && may_go(state, state.jobs.at(id));
  });
}

void add_conflict(const State& state, const Step& step, Edges& edges) {
  const FoundWaits found = found_in_the_way(state, step);
  const bool may_pass = may_have_another_way(state, step);
  for (const Wait& wait : found.all()) {
    if (may_pass && wait.kind != Wait::Kind::predecessor) continue;
    const auto first = has_to_move_first(state, wait);
    if (!first) continue;
    if (wait.kind == Wait::Kind::arm) {
      edges.push_back({step.id.job, *wait.arm});
      edges.push_back({*wait.arm, *first});
    } else {
      edges.push_back({step.id.job, *first});
    }
  }
}

// Without turns, an aged job holds back all others.
Closed aging(const Look& look, const Step& step) {
  const auto old = look.turns != nullptr ? look.turns->held_back_by(step) : any_aged(look.state);
  if (!old) return std::nullopt;
  const bool may_go = !look.state.is_judged(look.state.jobs.at(*old));
  if (!may_go || !step.is_waiting() || step.judgement().found.empty()) {
    return FoundWaits(Wait{.kind = Wait::Kind::predecessor,
                           .job = *old,
                           .detail = "that job has waited longer than aging_s"});
  }
  return FoundWaits(step.judgement().found);  // the aged job may be about to go
}

// Conditions in the order in which they are checked. Those that the planner, a client or a task
// ends have no edges. `aging` has none because no younger job holds back an aged job.
constexpr Gate kGates[] = {
    // another job of its arm precedes it; edges: add_behind(), queue by queue
    {behind, nullptr, EndedBy::queue, Blocks::start, /*of_its_arm=*/true},
    // a job with an undecided arm could bring this job's arm to its start
    {open_arm, add_open_arm, EndedBy::choice, Blocks::place},
    // a job in `after` has not ended
    {after, add_after, EndedBy::job, Blocks::start},
    // a path of the job is being planned, or its move to start is being checked
    {plan, nullptr, EndedBy::planner, Blocks::check},
    // its arm has retreated and first lets another job pass
    {lets_pass, add_lets_pass, EndedBy::job, Blocks::start},
    // one of its arms is stopped, or holds an object together with an arm that does not move
    {stop, nullptr, EndedBy::client, Blocks::start, /*of_its_arm=*/true},
    // a signal does not have the value at which the job starts
    {signal, nullptr, EndedBy::client, Blocks::start, false, false, /*defers_start=*/true},
    // actions of its task before it are not done; they may change what its arm holds
    {actions, nullptr, EndedBy::task, Blocks::plan, false, false, /*defers_start=*/true},
    // the policy allows no further job at the same time
    {place, add_place, EndedBy::job, Blocks::check, false, /*starts_age=*/true},
    // checked and not admitted; put_off() starts its age
    {conflict, add_conflict, EndedBy::job, Blocks::check},
    // an aged job goes first
    {aging, nullptr, EndedBy::job, Blocks::check},
};

void add_gates(const State& state, const Step& step, Edges& edges) {
  for (const Gate& gate : kGates) {
    if (gate.edges != nullptr) gate.edges(state, step, edges);
  }
}

}  // namespace

std::optional<ClosedGate> closed_gate(const Turns& turns, const Step& step) {
  const bool has_turn = has_turn_on_some_arm(turns.state(), step);
  for (const Gate& gate : kGates) {
    if (gate.of_its_arm && has_turn) continue;
    auto waits = gate.closed({turns.state(), &turns}, step);
    if (waits) return ClosedGate{gate, std::move(*waits)};
  }
  return std::nullopt;
}

std::optional<ClosedGate> first_closed(const State& state, const Step& step,
                                       bool (*counts)(const Gate&)) {
  for (const Gate& gate : kGates) {
    if (!counts(gate)) continue;
    if (auto waits = gate.closed({state}, step)) return ClosedGate{gate, std::move(*waits)};
  }
  return std::nullopt;
}

bool any_closed(const State& state, const Step& step, bool (*counts)(const Gate&)) {
  const Look look{.state = state, .tells = false};
  return std::ranges::any_of(
      kGates, [&](const Gate& gate) { return counts(gate) && gate.closed(look, step); });
}

bool lacks_only_actions(const State& state, const Step& step) {
  const auto others = [](const Gate& gate) {
    return blocks_start(gate) && !is_ended_by_task(gate);
  };
  return any_closed(state, step, is_ended_by_task) && !any_closed(state, step, others);
}

bool is_at_head(const State& state, const Step& step) {
  const auto by_jobs = [](const Gate& gate) {
    return blocks_start(gate) && !is_ended_by_client(gate);
  };
  return !any_closed(state, step, by_jobs);
}

bool stands(const State& state, const Step& step) {
  const bool behind = step.in<Admitted>() != nullptr && !is_at_head(state, step);
  return step.is_waiting() || behind || held_where_it_stands(state, step).has_value();
}

WaitsFor waits_for(const State& state) {
  Edges edges;
  std::set<std::pair<ArmId, StepId>> behind;
  for (const auto& queue : state.jobs.queues()) {
    if (!queue.empty()) add_behind(state, state.jobs.at(queue.back()), edges, behind);
  }
  for (const Step& step : state.jobs.of(state.jobs.active())) {
    if (stands(state, step)) add_gates(state, step, edges);
  }
  return WaitsFor(std::move(edges));
}

WaitsFor waits_for(const State& state, std::vector<JobId> jobs) {
  Edges edges;
  std::set<JobId> seen(jobs.begin(), jobs.end());
  std::set<std::pair<ArmId, StepId>> behind;
  while (!jobs.empty()) {
    const Step& step = state.jobs.at(jobs.back());
    jobs.pop_back();
    if (!stands(state, step)) continue;
    const std::size_t known = edges.size();
    add_behind(state, step, edges, behind);
    add_gates(state, step, edges);
    for (std::size_t i = known; i < edges.size(); ++i) {
      const auto* first = std::get_if<JobId>(&edges[i].first);
      if (first != nullptr && seen.insert(*first).second) jobs.push_back(*first);
    }
  }
  return WaitsFor(std::move(edges));
}

bool is_found_in_the_way(const State& state, const Step& step, JobId first) {
  const FoundWaits found = found_in_the_way(state, step);
  return std::ranges::any_of(found.all(), [&](const Wait& wait) {
    return wait.kind != Wait::Kind::predecessor && has_to_move_first(state, wait) == first;
  });
}

FoundWaits found_in_the_way(const State& state, const Step& step) {
  if (step.is_waiting()) {
    return state.is_judged(step) ? FoundWaits(step.judgement().found) : FoundWaits();
  }
  auto held = held_where_it_stands(state, step);
  return held ? FoundWaits(std::move(*held)) : FoundWaits();
}

// An undecided check is treated as a conflict, because it stays undecided while nothing moves.
std::optional<JobId> has_to_move_first(const State& state, const Wait& wait) {
  const JobBook& jobs = state.jobs;
  if (wait.kind == Wait::Kind::predecessor) {  // the safe sequence needs that job first
    const bool still = jobs.active().contains(*wait.job) && stands(state, jobs.at(*wait.job));
    return still ? wait.job : std::nullopt;
  }
  const bool of_job = wait.kind == Wait::Kind::job;
  if (!of_job && wait.kind != Wait::Kind::arm) return std::nullopt;
  if (of_job && !jobs.active().contains(*wait.job)) return std::nullopt;
  std::optional<JobId> first = wait.job;
  const bool begun = of_job && jobs.at(*wait.job).has_started();
  if (!begun && wait.arm) {  // its arm moves with its next job
    const auto& queue = jobs.queues()[*wait.arm];
    first = queue.empty() ? std::nullopt : std::optional(queue.front().job);
  }
  if (!first) return std::nullopt;
  return stands(state, jobs.at(*first)) ? first : std::nullopt;
}

}  // namespace armloom

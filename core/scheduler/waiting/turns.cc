#include "core/scheduler/waiting/turns.h"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

#include "core/jobs/standing.h"
#include "core/scheduler/waiting/capacity.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/waiting/options.h"

namespace armloom {
namespace {

bool is_aged(const State& state, const Step& step) {
  return step.in<Queued>() != nullptr && state.has_aged(step) &&
         !any_closed(state, step, blocks_start);
}

// Returns true if no other job can let this one go: it waits for an arm that no job moves, an
// object or a stop, or is in a deadlock cycle.
bool waits_beyond_turns(const State& state, const Step& step) {
  if (!step.job->ring.empty()) return true;
  if (const auto closed = first_closed(state, step, blocks_start)) {
    return is_ended_by_client(closed->gate);
  }
  if (!step.is_waiting() || !state.is_judged(step)) return false;
  return std::ranges::any_of(step.judgement().found, [&](const Wait& wait) {
    if (wait.kind != Wait::Kind::arm) return wait.kind == Wait::Kind::object;
    const auto& queue = state.jobs.queues()[*wait.arm];
    const bool moves = !queue.empty() && !state.jobs.at(queue.front()).is_waiting();
    return !moves && !has_to_move_first(state, wait);
  });
}

// Returns true if the job has a detour while it is checked (ways/detour.h).
bool has_way_for_a_while(const Step& step) {
  return step.goal && step.goal->detour && step.goal->detour->is_weighed;
}

// Returns the arm's first waiting job; nullopt if all are admitted.
std::optional<JobId> first_that_waits(const State& state, const ArmQueues::Queue& queue) {
  const auto waits = [&](StepId step) { return state.jobs.at(step).is_waiting(); };
  const auto first = std::ranges::find_if(queue, waits);
  return first == queue.end() ? std::nullopt : std::optional(first->job);
}

// Returns the jobs whose waits may have changed, ascending.
std::vector<JobId> to_explain(Transitions& state) {
  const std::set<JobId> unexplained = state.take_unexplained();
  std::vector<JobId> jobs;
  jobs.reserve(unexplained.size() + 2 * state->cell->arms.size() + kUndecidedMax);
  jobs.assign(unexplained.begin(), unexplained.end());
  for (const auto& queue : state->jobs.queues()) {
    if (queue.empty()) continue;
    jobs.push_back(queue.front().job);
    const auto first = first_that_waits(state, queue);
    if (first && *first != queue.front().job) jobs.push_back(*first);
  }
  std::ranges::copy(first_undecided(state), std::back_inserter(jobs));
  std::ranges::sort(jobs);
  const auto again = std::ranges::unique(jobs);
  jobs.erase(again.begin(), again.end());
  return jobs;
}

}  // namespace

// From the most urgent job on, each lends its priority to the jobs that it waits for, unless a more
// urgent one has reached them.
std::map<JobId, int> effective_priorities(const WaitsFor& graph, std::vector<Urgency> jobs) {
  std::ranges::stable_sort(jobs, std::ranges::greater{}, &Urgency::priority);
  std::map<JobId, int> effective;
  for (const Urgency& urgency : jobs) effective[urgency.job] = urgency.priority;
  std::vector<bool> reached(graph.nodes().size(), false);
  std::vector<std::size_t> open;
  for (const Urgency& urgency : jobs) {
    const std::size_t start = graph.index_of(urgency.job);
    if (start == graph.nodes().size() || reached[start]) continue;
    reached[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (const auto* job = std::get_if<JobId>(&graph.nodes()[node])) {
        const auto it = effective.find(*job);
        if (it != effective.end()) it->second = std::max(it->second, urgency.priority);
      }
      for (std::size_t first : graph.first_of(node)) {
        if (reached[first]) continue;
        reached[first] = true;
        open.push_back(first);
      }
    }
  }
  return effective;
}

std::optional<JobId> any_aged(const State& state) {
  if (has_rounds(state)) return std::nullopt;
  for (const auto& queue : state.jobs.queues()) {
    if (!queue.empty() && is_aged(state, state.jobs.at(queue.front()))) return queue.front().job;
  }
  return std::nullopt;
}

Turns::Turns(const State& state) : state_(state), aged_(aged_jobs()) {}

std::vector<Turns::Aged> Turns::aged_jobs() const {
  std::vector<Aged> aged;
  if (has_rounds(state_)) return aged;
  const JobBook& jobs = state_.jobs;
  for (const Step& head : jobs.heads()) {
    if (is_aged(state_, head)) aged.push_back({head.id.job, {}});
  }
  if (aged.empty()) return aged;
  std::ranges::sort(
      aged, {}, [&](const Aged& a) { return std::pair(jobs.at(a.job).ages_from->clock, a.job); });
  const auto again = std::ranges::unique(aged, {}, &Aged::job);  // a job of several arms
  aged.erase(again.begin(), again.end());
  const WaitsFor graph = waits_for(state_);
  for (Aged& a : aged) {
    for (const Waiter& before : graph.all_before(a.job)) {
      if (const auto* job = std::get_if<JobId>(&before)) a.goes_first.push_back(*job);
    }
  }
  std::erase_if(aged, [&](const Aged& a) {
    const auto in_vain = [&](JobId id) { return waits_beyond_turns(state_, jobs.at(id)); };
    return in_vain(a.job) || std::ranges::any_of(a.goes_first, in_vain);
  });
  return aged;
}

std::optional<JobId> Turns::held_back_by(const Step& step) const {
  if (step.in<Held>() != nullptr) return std::nullopt;
  for (const Aged& a : aged_) {
    // The aged job itself, or one that it waits for. Jobs that aged later do not hold it back.
    if (a.job == step.id.job) break;
    if (std::ranges::binary_search(a.goes_first, step.id.job)) break;
    const Step& old = state_.jobs.at(a.job);
    const bool outranks =
        step.id.job < old.id.job && step.job->terms.priority > old.job->terms.priority;
    if (!outranks) return a.job;
  }
  return std::nullopt;
}

// Returns an empty map if all jobs are equally urgent.
std::map<JobId, int> Turns::urgencies() const {
  if (state_.jobs.active().are_as_urgent()) return {};
  std::vector<Urgency> jobs;
  for (const Step& step : state_.jobs.of(state_.jobs.active())) {
    if (step.is_waiting()) jobs.push_back({step.id.job, step.job->terms.priority});
  }
  return effective_priorities(waits_for(state_), std::move(jobs));
}

bool Turns::is_closed(const Step& step) const {
  const auto known = std::ranges::find(found_, step.id.job, &std::pair<JobId, bool>::first);
  return known != found_.end() ? known->second : closed_gate(*this, step).has_value();
}

std::optional<JobId> Turns::next() const {
  const Step* best = nullptr;
  const std::map<JobId, int> urgency = urgencies();
  const auto goes_before = [&](const Step& a, const Step& b) {
    if (has_way_for_a_while(a) != has_way_for_a_while(b))
      return has_way_for_a_while(a);  // others must not rely on a path that it may lose
    if (a.asking.effort != b.asking.effort)
      return a.asking.effort < b.asking.effort;  // long checks come last
    const bool a_held = a.in<Held>() != nullptr;
    const bool b_held = b.in<Held>() != nullptr;
    if (a_held != b_held) return a_held;
    if (urgency.empty() || urgency.at(a.id.job) == urgency.at(b.id.job)) {
      return a.job->turn < b.job->turn;
    }
    return urgency.at(a.id.job) > urgency.at(b.id.job);
  };
  const auto consider = [&](JobId job) {
    const Step& step = state_.jobs.at(job);
    if (is_closed(step)) return;
    if (best == nullptr || goes_before(step, *best)) best = &step;
  };
  for (const auto& queue : state_.jobs.queues()) {
    if (const auto first = first_that_waits(state_, queue)) consider(*first);
  }
  std::ranges::for_each(first_undecided(state_), consider);
  return best != nullptr ? std::optional(best->id.job) : std::nullopt;
}

// Skips jobs behind the first of an arm, whose waits are unchanged.
Turns explain_waits(Transitions& state) {
  Turns turns(state);
  for (JobId id : to_explain(state)) {
    const Step& step = state->jobs.at(id);
    const bool waits = step.is_waiting();
    if (!waits && step.in<Admitted>() == nullptr) continue;
    const auto closed = waits ? closed_gate(turns, step) : first_closed(state, step, blocks_start);
    turns.has_found(id, closed.has_value());
    if (closed && closed->gate.starts_age) {
      state.jobs().begin_age(step, {state->now, state->clock()});
    }
    if (closed) {
      state.jobs().set_waits(step, closed->waits.all());
    } else if (waits) {  // until it is checked, its last waits stay
      state.jobs().set_waits(step, step.judgement().found);
    }
  }
  return turns;
}

}  // namespace armloom

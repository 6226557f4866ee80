#include "core/scheduler/waiting/wait_cycles.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "core/jobs/standing.h"
#include "core/scheduler/deadlines.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/ways/approach.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {
namespace {

bool is_on(const WaitCycle& ring, JobId job) { return std::ranges::find(ring, job) != ring.end(); }

JobId next_on(const WaitCycle& ring, std::size_t i) { return ring[(i + 1) % ring.size()]; }

// Returns the jobs whose waits may close a cycle. Every other job waits behind them.
std::vector<JobId> first_jobs(const State& state) {
  std::vector<JobId> first = first_undecided(state);
  for (const Step& head : state.jobs.heads()) first.push_back(head.id.job);
  return first;
}

bool waits_directly(const WaitsFor& graph, JobId job, JobId first) {
  const std::size_t node = graph.index_of(job), last = graph.index_of(first);
  if (node == graph.nodes().size()) return false;
  return std::ranges::any_of(graph.first_of(node), [&](std::size_t next) {
    if (next == last) return true;
    const bool is_arm = std::holds_alternative<ArmId>(graph.nodes()[next]);
    return is_arm && std::ranges::binary_search(graph.first_of(next), last);
  });
}

void untell(Transitions& state, const WaitCycle& ring) {
  for (JobId id : ring) {
    if (!state->jobs.active().contains(id)) continue;
    const Step& step = state->jobs.at(id);
    const auto* braking = step.in<Braking>();
    const bool ends_for_it = braking != nullptr && braking->after.then == AfterStop::Then::fail &&
                             braking->after.reason == Reason::deadlock;
    if (ends_for_it) continue;  // it names the ring when it has come to rest
    state.jobs().set(step, with(*step.job, &Job::ring, {}));
  }
}

// Lets an arm return first that has retreated for another job of the cycle.
bool comes_back(Transitions& state, const WaitCycle& ring) {
  for (const Step& step : state->jobs.of(ring)) {
    if (!lets_another_pass(state->jobs, step) || !is_on(ring, *step.job->errand.lets_pass))
      continue;
    state.let_pass(step, std::nullopt);
    return true;
  }
  return false;
}

// A job whose arm the server moves to its start needs no other job for that.
bool goes_before_open_arm(Transitions& state, const WaitCycle& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Step& step = state->jobs.at(ring[i]);
    const auto open = may_go_first(state, step);
    if (!step.is_brought_to_start() || open != next_on(ring, i)) continue;
    Approaches approaches = step.approaches;
    approaches.ahead_of.insert(*open);
    state.jobs().set(step, std::move(approaches));
    return true;
  }
  return false;
}

bool one_expires(const State& state, const WaitCycle& ring) {
  return std::ranges::any_of(
      ring, [&](JobId id) { return expiry_of(state, state.jobs.at(id)).has_value(); });
}

bool is_asked(const State& state, const WaitCycle& ring) {
  return std::ranges::any_of(ring, [&](JobId id) {
    const Step* step = state.jobs.find(id);
    return step != nullptr && step->is_replanned_now();
  });
}

// Replans jobs of the cycle one by one, the last one first. Returns true if a replan is open.
bool goes_around(Transitions& state, const WaitCycle& ring) {
  if (is_asked(state, ring)) return true;
  WaitCycle from_last = ring;
  std::ranges::sort(from_last, std::greater<>());
  for (JobId id : from_last) {
    if (!may_go_around(state, state->jobs.at(id))) continue;
    ask_for_another_way(state, state->jobs.at(id), AnotherWay::Cause::blocked);
    return true;
  }
  return false;
}

}  // namespace

void WaitCycles::name(Transitions& state) {
  for (WaitCycle& ring : find_wait_cycles(waits_for(state, first_jobs(state)))) {
    const bool told = std::ranges::any_of(named_, [&](const Named& named) {
      return std::ranges::find_first_of(named.ring, ring) != named.ring.end();
    });
    if (told) continue;
    Named named{.ring = ring, .epoch = state->around.scene_since, .in_turn = {}};
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Step& step = state->jobs.at(ring[i]);
      if (!is_found_in_the_way(state, step, next_on(ring, i))) named.in_turn.push_back(ring[i]);
      state.jobs().set(step, with(*step.job, &Job::ring, beginning_with(ring[i], ring)));
    }
    named_.push_back(std::move(named));
  }
}

// Conflicts in a cycle stay until one of its jobs goes or the scene changes, because no arm of it
// moves. Other waits may end.
bool WaitCycles::stands_still(const State& state, const Named& named) const {
  const WaitCycle& ring = named.ring;
  const bool all_stand =
      named.epoch == state.around.scene_since && std::ranges::all_of(ring, [&](JobId id) {
        return state.jobs.active().contains(id) && stands(state, state.jobs.at(id));
      });
  if (!all_stand || named.in_turn.empty()) return all_stand;
  const WaitsFor graph = waits_for(state, ring);
  return std::ranges::all_of(named.in_turn, [&](JobId id) {
    const auto place = std::ranges::find(ring, id) - ring.begin();
    return waits_directly(graph, id, next_on(ring, static_cast<std::size_t>(place)));
  });
}

void WaitCycles::settle(Transitions& state) {
  for (Named& named : std::exchange(named_, {})) {
    const bool stood = stands_still(state, named);
    if (stood &&
        (goes_before_open_arm(state, named.ring) || leaves_by_other_arm(state, named.ring))) {
      untell(state, named.ring);
      continue;
    }
    named.way_out =
        stood && (goes_around(state, named.ring) || yield_in(state, named.ring).has_value() ||
                  !resolve(state, named.ring));
    if (named.way_out) {
      named_.push_back(std::move(named));
    } else {
      untell(state, named.ring);
    }
  }
}

bool WaitCycles::has_lost_one(const State& state, const Step& step) const {
  return std::ranges::any_of(step.trajectory->arms(), [&](ArmId arm) {
    const auto lost = lost_.find(arm);
    return lost != lost_.end() && lost->second.epoch == state.around.scene_since &&
           lost->second.came_by == state.arms.came_by(arm);
  });
}

// Returns the job that fails: a retreat or return that no client's job needs, or else the job that
// clients submitted last. nullopt if all arms of the cycle have lost a job here, and one of its
// jobs expires in time.
std::optional<JobId> WaitCycles::gives_way(const State& state, const WaitCycle& ring) const {
  const auto dispensable = [&](JobId id) {
    const Step& step = state.jobs.at(id);
    return std::tuple(!step.job->system_job || !is_counted_on(state, step), step.job->system_job,
                      id);
  };
  WaitCycle last = ring;
  std::erase_if(last, [&](JobId id) { return has_lost_one(state, state.jobs.at(id)); });
  if (last.empty() && one_expires(state, ring)) return std::nullopt;
  return *std::ranges::max_element(last.empty() ? ring : last, {}, dispensable);
}

// Returns false if the ring is left to its timeouts. An approach fails together with its job,
// because another approach would close the same ring.
bool WaitCycles::resolve(Transitions& state, const WaitCycle& ring) {
  if (comes_back(state, ring)) return true;
  const auto id = gives_way(state, ring);
  if (!id) return false;
  const Step& last = state->jobs.at(approached_job(state, *id).value_or(*id));
  state.jobs().set(last, with(*last.job, &Job::ring, state->jobs.at(*id).job->ring));
  keep_those_behind(state, last);
  for (ArmId arm : last.trajectory->arms()) {
    if (last.job->system_job) break;
    lost_.insert_or_assign(arm, Lost{state->arms.came_by(arm), state->around.scene_since});
  }
  give_up_with_approaches(state, last, {AfterStop::Then::fail, Reason::deadlock});
  return true;
}

bool WaitCycles::is_one_to_settle() const {
  return std::ranges::any_of(named_, [](const Named& n) { return !n.way_out; });
}

std::optional<YieldTrial> WaitCycles::next_yield(const State& state) const {
  for (const Named& named : named_) {
    if (is_asked(state, named.ring)) continue;
    if (auto move = yield_in(state, named.ring)) return move;
  }
  return std::nullopt;
}

void WaitCycles::has_opened(Transitions& state, JobId before) {
  std::erase_if(named_, [&](const Named& named) {
    const bool opened = is_on(named.ring, before);
    if (opened) untell(state, named.ring);
    return opened;
  });
}

}  // namespace armloom

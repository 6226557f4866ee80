#include "core/scheduler/waiting/wait_cycles.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "core/jobs/phases.h"
#include "core/jobs/standing.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {
namespace {

bool is_on(const WaitCycle& ring, JobId job) { return std::ranges::find(ring, job) != ring.end(); }

// Orders alone make no ring: all follow one sequence. And only the first job of an arm is judged.
bool one_is_in_the_way(const State& state) {
  return std::ranges::any_of(state.jobs.queues(), [&](const auto& queue) {
    if (queue.empty()) return false;
    const FoundWaits waits = found_in_the_way(state, state.jobs.at(queue.front()));
    return std::ranges::any_of(waits.all(), [&](const Wait& wait) {
      return wait.kind != Wait::Kind::order && has_to_move_first(state, wait).has_value();
    });
  });
}

// No arm of a ring moves while its jobs wait. So a ring that was found stands until one of these
// goes, or the scene is another one.
bool ring_stands(const State& state, const WaitCycle& ring, Version epoch) {
  return epoch == state.recheck_epoch && std::ranges::all_of(ring, [&](JobId id) {
           return state.jobs.is_active(id) && stands(state, state.jobs.at(id));
         });
}

void untell(State& state, const WaitCycle& ring) {
  for (JobId id : ring) {
    if (!state.jobs.is_active(id)) continue;
    Record& record = state.jobs.at(id);
    const auto* braking = record.job.in<Braking>();
    const bool ends_for_it = braking != nullptr && braking->after.then == AfterStop::Then::fail &&
                             braking->after.reason == Reason::deadlock;
    if (ends_for_it) continue;  // it names the ring when it has come to rest
    record.job.ring.clear();
    state.jobs.changed(record);
  }
}

// An arm that is aside for the sake of another one of the ring comes back first. Else a move aside
// gives way, or the last job that a client sent: the others were there before it closed the ring.
// Not a return, or a move aside on which a client's job counts by now.
void resolve(State& state, const WaitCycle& ring) {
  for (JobId id : ring) {
    Record& record = state.jobs.at(id);
    if (lets_another_pass(state.jobs, record) && is_on(ring, *record.errand.lets_pass)) {
      record.errand.lets_pass.reset();
      state.lanes.renew_later();
      return;
    }
  }
  const auto dispensable = [&](JobId id) {
    const Record& record = state.jobs.at(id);
    return std::tuple(!record.job.system_job || !is_counted_on(state, record),
                      record.job.system_job, id);
  };
  Record& last = state.jobs.at(*std::ranges::max_element(ring, {}, dispensable));
  give_up(state, last, {AfterStop::Then::fail, Reason::deadlock});
}

bool is_asked(const State& state, const WaitCycle& ring) {
  return std::ranges::any_of(ring, [&](JobId id) {
    const Record* record = state.jobs.find(id);
    return record != nullptr && record->job.is_replanned_now();
  });
}

// Whether one of the ring may have another way: they are asked one by one, the last one first.
bool goes_around(State& state, const WaitCycle& ring) {
  if (is_asked(state, ring)) return true;
  WaitCycle from_last = ring;
  std::ranges::sort(from_last, std::greater<>());
  for (JobId id : from_last) {
    if (!may_go_around(state, state.jobs.at(id))) continue;
    ask_for_another_way(state, state.jobs.at(id), AnotherWay::Cause::blocked);
    return true;
  }
  return false;
}

}  // namespace

void WaitCycles::name(State& state) {
  if (!one_is_in_the_way(state)) return;
  for (WaitCycle& ring : find_wait_cycles(waits_for(state))) {
    const bool told = std::ranges::any_of(named_, [&](const Named& named) {
      return std::ranges::find_first_of(named.ring, ring) != named.ring.end();
    });
    if (told) continue;
    for (JobId id : ring) {
      Record& record = state.jobs.at(id);
      record.job.ring = beginning_with(id, ring);
      state.jobs.changed(record);
    }
    named_.push_back({std::move(ring), state.recheck_epoch});
  }
}

void WaitCycles::settle(State& state) {
  for (Named& named : std::exchange(named_, {})) {
    const bool stood = ring_stands(state, named.ring, named.epoch);
    if (stood && leaves_by_other_arm(state, named.ring)) {
      untell(state, named.ring);
      continue;
    }
    named.way_out =
        stood && (goes_around(state, named.ring) || yield_in(state, named.ring).has_value());
    if (named.way_out) {
      named_.push_back(std::move(named));
      continue;
    }
    if (stood) resolve(state, named.ring);
    untell(state, named.ring);
  }
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

void WaitCycles::has_opened(State& state, JobId before) {
  std::erase_if(named_, [&](const Named& named) {
    const bool opened = is_on(named.ring, before);
    if (opened) untell(state, named.ring);
    return opened;
  });
}

}  // namespace armloom

#include "core/scheduler/putting_off.h"

#include <algorithm>
#include <utility>

#include "core/coordination/effort.h"
#include "core/jobs/phases.h"
#include "core/jobs/waits.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/ways/detour.h"

namespace armloom {
namespace {

// What a job waits for that is treated as a conflict without being proven one.
constexpr const char* kUndecided = "undecided: the check exceeded its budget of evaluations";
// So often is the budget of one job's questions raised.
constexpr int kRaisedMax = 12;

// Nothing: it hits itself, and has not begun.
std::optional<std::vector<Wait>> waits_for(State& state, Record& record, const Verdict& verdict) {
  if (fails_by_itself(state, record, verdict)) return std::nullopt;
  std::vector<Wait> waits;
  for (const Conflict& conflict : verdict.conflicts) {
    if (conflict.with == Conflict::With::rest && conflict.proximity.arm_b) {
      state.lanes.learn_in_the_way(record.job.step(), *conflict.proximity.arm_b,
                                   {conflict.proximity, conflict.own_time}, state.jobs, state.arms);
    }
    waits.push_back(wait_for(conflict));
    if (verdict.kind == Verdict::Kind::undecided) waits.back().detail = kUndecided;
  }
  return waits;
}

// As it was found before; what is otherwise by now is seen when ways aside are tried.
bool has_no_way_aside(const Job& job, const Wait& wait) {
  return std::ranges::any_of(job.waits_on, [&](const Wait& was) {
    return was.has_no_way_aside && was.arm == wait.arm && was.kind == wait.kind;
  });
}

Judgement& judgement_of(Record& record) {
  auto* held = std::get_if<Held>(&record.job.phase);
  return held != nullptr ? held->judgement : std::get<Queued>(record.job.phase).judgement;
}

// Out of the backlog, where it is there.
void stay_queued(State& state, Record& record, Judgement found) {
  if (gives_detour_up(state, record)) return;
  const auto* queued = record.job.in<Queued>();
  if (queued != nullptr && queued->in_backlog) {
    enter(state, record, Queued{});
    record.job.times.backlogged_at.reset();
    state.jobs.changed(record);
  }
  judgement_of(record) = std::move(found);
  if (!record.ages_from && is_at_head(state, record)) {
    record.ages_from = {state.now, state.clock()};
  }
  state.jobs.set_waits(record, record.job.judgement().found);
}

}  // namespace

bool fails_by_itself(State& state, Record& record, const Verdict& verdict) {
  const auto self = std::ranges::find(verdict.conflicts, Conflict::With::self, &Conflict::with);
  if (self == verdict.conflicts.end() || record.job.has_started()) return false;
  end(state, record, JobState::failed, Reason::self_collision, self_collision_text(*self));
  return true;
}

void note_found(Record& record, std::vector<Wait> waits) {
  judgement_of(record).found = std::move(waits);
}

void put_off(State& state, Record& record, std::vector<Wait> waits) {
  record.asking.effort = 1;
  if (gives_detour_up(state, record)) return;
  for (Wait& wait : waits) wait.has_no_way_aside = has_no_way_aside(record.job, wait);
  state.jobs.set_waits(record, waits);
  judgement_of(record) = {state.version, std::move(waits)};
  if (!is_at_head(state, record)) return;  // it has had no turn yet
  if (!record.ages_from) record.ages_from = {state.now, state.clock()};
  const auto* queued = record.job.in<Queued>();
  if (queued != nullptr && !queued->in_backlog) {
    enter(state, record, Queued{.in_backlog = true, .judgement = queued->judgement});
    if (!record.job.times.backlogged_at) {
      record.job.times.backlogged_at = state.now;
      record.job.times.backlog_clock = state.clock();
    }
    state.jobs.changed(record);
  }
}

bool put_off_where_it_stands(State& state, Record& record) {
  const GoalWay* way = record.job.stands_in();
  if (way == nullptr) return false;
  put_off(state, record, {Wait{.kind = Wait::Kind::object, .proximity = way->stands_in}});
  return true;
}

void wait_behind(State& state, Record& record, JobId first) {
  stay_queued(state, record,
              {state.version, {Wait{.kind = Wait::Kind::predecessor, .job = first}}});
}

void wait_in_turn(State& state, Record& record, const SafeSequence::Outlook& outlook) {
  Wait wait{.kind = Wait::Kind::predecessor, .job = outlook.first->job};
  const auto& ends = record.leg.to;
  if (outlook.block && std::ranges::find(ends, outlook.in_the_way) != ends.end()) {
    wait.arm = outlook.block->proximity.arm_a;
    wait.proximity = turned_around(outlook.block->proximity);
    wait.own_time = record.job.trajectory->duration();
    wait.other_time = outlook.block->time;
  }
  stay_queued(state, record, {state.version, {std::move(wait)}, outlook.first});
}

void refuse(State& state, Record& record, const Verdict& verdict) {
  if (auto waits = waits_for(state, record, verdict)) put_off(state, record, std::move(*waits));
}

void hold_back(State& state, Record& record, const Verdict& verdict) {
  auto waits = waits_for(state, record, verdict);
  if (!waits) return;
  brake(state, record, {});
  state.jobs.set_waits(record, *waits);
}

bool is_asked_again(Record& record, const Verdict& verdict) {
  const auto effort = larger_effort(verdict, record.asking.effort);
  if (!effort || record.asking.raised >= kRaisedMax) return false;
  record.asking.effort = *effort;
  ++record.asking.raised;
  return true;
}

}  // namespace armloom

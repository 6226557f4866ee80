#include "core/scheduler/putting_off.h"

#include <algorithm>
#include <utility>

#include "core/coordination/effort.h"
#include "core/jobs/waits.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/ways/detour.h"

namespace armloom {
namespace {

// Detail of a wait for an undecided check, which is treated as a conflict.
constexpr const char* kUndecided = "undecided: the check exceeded its budget of evaluations";
// Largest number of times that one job's budget is raised.
constexpr int kRaisedMax = 12;

// Returns the waits for what the check found; nullopt if the job has failed by a self-collision.
std::optional<std::vector<Wait>> waits_for(Transitions& state, const Step& step,
                                           const Verdict& verdict) {
  if (fails_by_itself(state, step, verdict)) return std::nullopt;
  std::vector<Wait> waits;
  for (const Conflict& conflict : verdict.conflicts) {
    if (conflict.with == Conflict::With::rest && conflict.proximity.arm_b) {
      state.lanes().learn_in_the_way(step.id, *conflict.proximity.arm_b,
                                     {conflict.proximity, conflict.own_time}, state->jobs,
                                     state->arms);
    }
    waits.push_back(wait_for(conflict));
    if (verdict.kind == Verdict::Kind::undecided) waits.back().detail = kUndecided;
  }
  return waits;
}

// Returns true if no retreat was found for the same wait. This is kept until retreats are tried
// again.
bool has_no_way_aside(const Step& step, const Wait& wait) {
  return std::ranges::any_of(step.waits_on, [&](const Wait& was) {
    return was.has_no_way_aside && was.arm == wait.arm && was.kind == wait.kind;
  });
}

// Lets the job wait outside the backlog.
void stay_queued(Transitions& state, const Step& step, Judgement found) {
  if (gives_detour_up(state, step)) return;
  state.jobs().leave_backlog(step);
  state.jobs().set(step, std::move(found));
  if (!step.ages_from && is_at_head(state, step)) {
    state.jobs().begin_age(step, {state->now, state->clock()});
  }
  state.jobs().set_waits(step, step.judgement().found);
}

}  // namespace

bool fails_by_itself(Transitions& state, const Step& step, const Verdict& verdict) {
  if (verdict.kind != Verdict::Kind::conflict || step.has_started()) return false;
  const auto self = std::ranges::find(verdict.conflicts, Conflict::With::self, &Conflict::with);
  if (self == verdict.conflicts.end()) return false;
  state.give_up(step, {AfterStop::Then::fail, Reason::self_collision, self_collision_text(*self)});
  return true;
}

void note_found(Transitions& state, const Step& step, std::vector<Wait> waits) {
  state.jobs().set(step, with(step.judgement(), &Judgement::found, std::move(waits)));
}

void put_off(Transitions& state, const Step& step, std::vector<Wait> waits) {
  state.jobs().set(step, with(step.asking, &Asking::effort, 1));
  if (gives_detour_up(state, step)) return;
  for (Wait& wait : waits) wait.has_no_way_aside = has_no_way_aside(step, wait);
  state.jobs().set_waits(step, waits);
  state.jobs().set(step, Judgement{state->version(), std::move(waits)});
  if (!is_at_head(state, step)) return;  // it has had no turn yet
  state.jobs().begin_age(step, {state->now, state->clock()});
  state.jobs().put_in_backlog(step, state->now, state->clock());
}

bool put_off_where_it_stands(Transitions& state, const Step& step) {
  const GoalWay* way = step.stands_in();
  if (way == nullptr) return false;
  put_off(state, step, {Wait{.kind = Wait::Kind::object, .proximity = way->stands_in}});
  return true;
}

void wait_behind(Transitions& state, const Step& step, JobId first) {
  stay_queued(state, step,
              {state->version(), {Wait{.kind = Wait::Kind::predecessor, .job = first}}});
}

void wait_in_turn(Transitions& state, const Step& step, const SafeSequence::Outlook& outlook) {
  Wait wait{.kind = Wait::Kind::predecessor, .job = outlook.first->job};
  const auto& ends = step.leg.to;
  if (outlook.block && std::ranges::find(ends, outlook.in_the_way) != ends.end()) {
    wait.arm = outlook.block->proximity.arm_a;
    wait.proximity = turned_around(outlook.block->proximity);
    wait.own_time = step.trajectory->duration();
    wait.other_time = outlook.block->time;
  }
  stay_queued(state, step,
              {state->version(),
               {std::move(wait)},
               Judgement::InTurn{*outlook.first, state->lanes.newest()}});
}

void refuse(Transitions& state, const Step& step, const Verdict& verdict) {
  if (auto waits = waits_for(state, step, verdict)) put_off(state, step, std::move(*waits));
}

std::vector<Wait> waits_for_rest(const Step& step, const Verdict& verdict) {
  std::vector<Wait> waits;
  for (const PairRegions& pair : verdict.regions) {
    const auto* arm = std::get_if<ArmId>(&pair.b);
    if (arm == nullptr) continue;
    const ConflictRegion& region = pair.regions.front();
    waits.push_back(wait_for(
        Blocker{step.id, std::nullopt, *arm, region.proximity, region.time_a, region.time_b}));
  }
  return waits;
}

bool holds_back(Transitions& state, const Step& step, const Verdict& verdict) {
  const bool is_free = verdict.kind == Verdict::Kind::free;
  const auto waits =
      is_free ? std::optional(waits_for_rest(step, verdict)) : waits_for(state, step, verdict);
  if (!waits) return true;  // it has failed
  if (waits->empty()) return false;
  state.brake(step, {});
  state.jobs().set_waits(step, *waits);
  return true;
}

bool is_asked_again(Transitions& state, const Step& step, const Verdict& verdict) {
  const auto effort = larger_effort(verdict, step.asking.effort);
  if (!effort || step.asking.raised >= kRaisedMax) return false;
  Asking asking = step.asking;
  asking.effort = *effort;
  ++asking.raised;
  state.jobs().set(step, asking);
  return true;
}

}  // namespace armloom

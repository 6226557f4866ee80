#include "core/scheduler/admission.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/jobs/waits.h"
#include "core/model/promises.h"
#include "core/policies/policy.h"
#include "core/scheduler/groups.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/putting_off.h"
#include "core/scheduler/waiting/turns.h"
#include "core/scheduler/ways/approach.h"
#include "core/scheduler/ways/detour.h"
#include "core/scheduler/ways/replanning.h"
#include "core/scheduler/weighing.h"
#include "core/scheduler/yielding/making_way.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

// In one step a job is put off once, or a few times if the sequence of waiting jobs changes. More
// than this for each job, and as much for 32 more, is an endless loop.
constexpr std::size_t kPutOffMax = 32;

// Returns the motion that has to be checked again and whose last check is the oldest; nullopt if
// none has.
std::optional<StepId> next_recheck(const State& state) {
  std::optional<StepId> next;
  for (const Step& step : state.jobs.past_queue()) {
    if (!step.is_admitted() || !step.asking.is_in_question) continue;
    const bool is_older =
        !next || step.asking.found_free_at < state.jobs.at(*next).asking.found_free_at;
    if (is_older) next = step.id;
  }
  return next;
}

// Returns what remains of the safe sequence if these steps are admitted.
SafeSequence::Outlook outlook_with(Transitions& state, const std::vector<StepId>& steps) {
  return state.lanes().after(steps, state->jobs, state->arms);
}

// Records that a check found the admitted motion free in the present version.
void note_free(Transitions& state, const Step& step) {
  Asking asking = step.asking;
  asking.found_free_at = state->version();
  asking.is_in_question = false;
  state.jobs().set(step, asking);
}

// Counts, for the first job of each arm, the admitted jobs that overtake it after it has waited for
// `aging_s`.
void note_overtaken(Transitions& state, const std::vector<StepId>& admitted) {
  std::set<StepId> told;  // a step of several arms is the first of several queues
  for (const Step& step : state->jobs.heads()) {
    const bool waits_long = step.in<Queued>() != nullptr && state->has_aged(step);
    if (!waits_long || !told.insert(step.id).second) continue;
    const auto overtaking = std::ranges::count_if(admitted, [&](StepId id) {
      const Step& other = state->jobs.at(id);
      return id != step.id && !other.job->system_job && step.job->turn < other.job->turn;
    });
    if (overtaking == 0) continue;
    const std::size_t before = step.starvation ? step.starvation->overtaken_by : 0;
    state.jobs().set(step,
                     Starvation{step.ages_from->at, before + static_cast<std::size_t>(overtaking)});
  }
}

// Admits the steps with these orders. `candidates`: the motion of each step, in the same order.
void admit(Transitions& state, const std::vector<StepId>& steps,
           std::vector<CoordinatedMotion> candidates, const PassingOrders& orders) {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Trajectory& trajectory = *state->jobs.at(steps[i]).trajectory;
    candidates[i].horizon = from_seconds(stopping_reach_s(*state->cell, trajectory)) +
                            state->cell->monitor.reaction +
                            promises_of(*state->cell, trajectory.arms()).free_run();
  }
  state.admit(steps, candidates, orders);
  for (StepId id : steps) note_free(state, state->jobs.at(id));
  note_overtaken(state, steps);
}

// Readmits a motion that was stopped on its path, with its orders. It waits instead if an arm has
// come to rest in its way.
void go_on(Transitions& state, const Step& step, const Verdict& verdict) {
  std::vector<Wait> waits = waits_for_rest(step, verdict);
  if (!waits.empty()) return put_off(state, step, std::move(waits));
  state.readmit(step);
  note_free(state, step);
}

}  // namespace

// ---- Questions ----

bool Admission::ask_next(Transitions& state, const Turns& turns, const WaitCycles& cycles) {
  if (open_) return false;
  bool put_off = false;
  if (const auto recheck = next_recheck(state)) {
    ask_about(state, *recheck, question_now(state, {*recheck}), Purpose::recheck);
    return put_off;
  }
  if (const auto job = next_in_question(state)) {
    Question question = question_by_itself(state, state->jobs.at(*job));
    ask_about(state, only_step(*job), std::move(question), Purpose::itself);
    return put_off;
  }
  std::optional<JobId> turn;
  if (auto opens = cycles.next_yield(state)) {
    ask_yield(state, std::move(*opens));
    if (open_) return put_off;
    turn = Turns(state).next();
  } else {
    turn = turns.next();
  }
  std::size_t times_put_off = 0;
  for (; turn; turn = Turns(state).next()) {
    if (++times_put_off > kPutOffMax * (state->jobs.active().size() + kPutOffMax)) {
      throw std::logic_error("endless loop: one step deferred jobs " +
                             std::to_string(times_put_off) + " times, last job " +
                             std::to_string(turn->value()));
    }
    if (put_off_where_it_stands(state, state->jobs.at(*turn))) {
      put_off = true;
      continue;
    }
    const bool is_choice = choosing_.begin(state, *turn);
    const StepId step = only_step(choosing_.job());
    auto outlook = outlook_with(state, {step});
    if (!outlook.first) {
      ask(state, {step}, std::move(outlook), is_choice ? Purpose::option : Purpose::start);
      open_->is_only_option = !is_choice;
      return put_off;
    }
    wait_in_turn(state, state->jobs.at(step), outlook);
    put_off = true;
  }
  if (goes_around_idle_arm(state)) return true;
  if (auto idle = next_yield(state)) ask_yield(state, std::move(*idle));
  return put_off;
}

void Admission::ask(Transitions& state, std::vector<StepId> steps, SafeSequence::Outlook outlook,
                    Purpose purpose) {
  Question question = question_now(state, steps);
  question.effort = state->jobs.at(steps.front()).asking.effort;
  std::vector<Passage> unknown = std::move(outlook.unknown);
  std::ranges::move(outlook.ahead, std::back_inserter(unknown));
  add_passages(question, unknown, state);
  open_ = OpenQuestion{state->version(), std::move(steps), purpose, {}, std::move(unknown)};
  state.effect(Judge{std::move(question)});
}

void Admission::ask_about(Transitions& state, StepId step, Question question, Purpose purpose) {
  open_ = OpenQuestion{state->version(), {step}, purpose};
  state.effect(Judge{std::move(question)});
}

void Admission::ask_yield(Transitions& state, YieldTrial move) {
  if (!move.way) return ask_for_way_aside(state, move);
  Question question = question_about(state, move);
  open_ = OpenQuestion{
      state->version(), {only_step(move.blocked_job)}, Purpose::yield, std::move(move)};
  state.effect(Judge{std::move(question)});
}

// ---- Answers ----

void Admission::on(const Judged& input, Transitions& state, WaitCycles& cycles) {
  if (!open_ || open_->version != input.verdict.version) return;
  OpenQuestion question = std::move(*open_);
  open_.reset();
  if (input.verdict.interrupted) return;  // void: asked again if still needed
  if (question.version >= state->around.scene_since) {
    state.lanes().learn(question.passages, input.verdict, state->jobs);
  }
  if (question.version != state->version()) return;  // stale: it is asked again
  switch (question.purpose) {
    case Purpose::yield:
      return answer_yield(state, input.verdict, std::move(*question.yield), cycles);
    case Purpose::itself: {
      const Step& step = state->jobs.at(question.steps.front());
      using Feasibility = Approaches::Feasibility;
      state.jobs().set(step, with(step.approaches, &Approaches::feasibility, Feasibility::given));
      if (input.verdict.kind == Verdict::Kind::conflict) {
        (void)fails_by_itself(state, step, input.verdict);
      }
      return;
    }
    case Purpose::recheck: {
      const Step& step = state->jobs.at(question.steps.front());
      // It stays in question until it is found free.
      if (!holds_back(state, step, input.verdict)) note_free(state, step);
      return;
    }
    case Purpose::option:
      return answer_option(state, input.verdict);
    case Purpose::start:
      // Further options have come meanwhile. Then all options are checked.
      if (question.is_only_option && options_of(state, question.steps.front().job).size() > 1)
        return;
      return answer_start(state, input.verdict, question.steps);
  }
}

void Admission::answer_yield(Transitions& state, const Verdict& verdict, YieldTrial move,
                             WaitCycles& cycles) {
  if (!is_as_asked(state, move)) return;
  const bool passes = lets_through(state, verdict, move);
  if (passes && !move.is_free) {
    move.is_free = true;
    return ask_yield(state, std::move(move));
  }
  note_tried(state, move, passes);
  if (!passes) return;
  send_aside(state, move);
  if (move.before) cycles.has_opened(state, *move.before);
}

void Admission::answer_option(Transitions& state, Verdict verdict) {
  if (!choosing_.stands(state)) return;
  if (choosing_.rate(state, std::move(verdict))) {
    const std::vector<StepId> next{only_step(choosing_.job())};
    return ask(state, next, outlook_with(state, next), Purpose::option);
  }
  const auto best = choosing_.decide(state);
  if (best) return answer_start(state, *best, {only_step(choosing_.job())});
  const Step& step = state->jobs.at(choosing_.job());
  wait_behind(state, step, state->jobs.queues().before(step, step.leg.arms.front())->job);
}

void Admission::answer_start(Transitions& state, const Verdict& verdict,
                             const std::vector<StepId>& steps) {
  const Step& first = state->jobs.at(steps.front());
  if (verdict.kind == Verdict::Kind::free) {
    if (state->graph.holds(first.id)) return go_on(state, first, verdict);
    return decide(state, verdict, steps);
  }
  if (is_asked_again(state, first, verdict)) return;
  if (steps.size() == 1) return refuse(state, first, verdict);
  if (tries_together(state, steps, false)) return;
  put_off(state, first, first.judgement().found);  // another job of its group cannot go
}

void Admission::decide(Transitions& state, const Verdict& verdict,
                       const std::vector<StepId>& steps) {
  const Step& first = state->jobs.at(steps.front());
  if (!follow_each_other(state, steps)) {
    // Another arm was chosen for a job before one of these, or its plan is old.
    if (steps.size() == 1 || !tries_together(state, steps, false)) {
      put_off(state, first, first.judgement().found);
    }
    return;
  }
  prepare_choice(state, steps);
  std::vector<CoordinatedMotion> candidates;
  for (StepId step : steps) candidates.push_back(as_candidate(state, state->jobs.at(step)));
  const PassingOrders orders =
      state->policy->decide(state->graph.question(candidates, verdict.regions));
  const bool can_go = orders.blockers.empty();
  if (!can_go && is_asked_again(state, first, verdict)) return;  // its blockers are not known yet
  if (can_go && take_arms_that_remain(state, steps)) return;
  if (steps.size() == 1 && weighs_detour(state, first, verdict.regions, orders)) return;
  if (tries_together(state, steps, can_go)) return;
  if (can_go) {
    if (leaves_a_sequence(state, steps)) {
      admit(state, steps, std::move(candidates), orders);
    } else if (!open_) {
      (void)tries_together(state, steps, false);
    }
    return;
  }
  std::vector<Wait> waits;
  for (const Blocker& blocker : orders.blockers) {
    if (blocker.blocked != first.id) continue;
    if (blocker.arm) {
      state.lanes().learn_in_the_way(first.id, *blocker.arm, {blocker.proximity, blocker.own_time},
                                     state->jobs, state->arms);
    }
    waits.push_back(wait_for(blocker));
  }
  if (steps.size() == 1 || !waits.empty()) note_found(state, first, std::move(waits));
  std::vector<StepId> group = with_next_jobs(state, steps, orders.in_the_way);
  if (group.size() > steps.size()) return ask(state, group, outlook_with(state, group));
  put_off(state, first, first.judgement().found);
}

// Returns true if the jobs may be admitted. Otherwise they wait, or the next question is asked.
bool Admission::leaves_a_sequence(Transitions& state, const std::vector<StepId>& steps) {
  auto outlook = outlook_with(state, steps);
  const Step& first = state->jobs.at(steps.front());
  if (!outlook.unknown.empty()) {
    ask(state, steps, std::move(outlook));
  } else if (outlook.first && steps.size() > 1) {
    put_off(state, first, first.judgement().found);  // a group does not wait in turn
  } else if (outlook.first) {
    wait_in_turn(state, first, outlook);
  } else {
    return true;
  }
  return false;
}

// Used if some waiting jobs fit into no sequence. First tries all waiting jobs as one group; if
// that fails, these steps alone. Returns true if a question was asked.
bool Admission::tries_together(Transitions& state, const std::vector<StepId>& steps, bool can_go) {
  if (!state->policy->lookahead.admits_groups) return false;
  const bool tried = together_ && together_->version == state->version();
  if (!can_go) {
    if (!tried || together_->alone.empty()) return false;
    const std::vector<StepId> alone = std::exchange(together_->alone, {});
    ask(state, alone, outlook_with(state, alone));
    return true;
  }
  if (tried) return false;
  auto outlook = outlook_with(state, steps);
  if (!outlook.ahead.empty()) {  // they are not checked yet
    ask(state, steps, std::move(outlook));
    return true;
  }
  if (outlook.all) return false;
  const std::vector<StepId> all = with_all_that_wait(state, steps);
  if (all.size() == steps.size() || all.size() > kTogetherMax) return false;
  together_ = Together{state->version(), steps};
  ask(state, all, outlook_with(state, all));
  return true;
}

}  // namespace armloom

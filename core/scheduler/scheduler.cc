#include "core/scheduler/scheduler.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/jobs/invariants.h"
#include "core/jobs/standing.h"
#include "core/scheduler/authority.h"
#include "core/scheduler/deadlines.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/putting_off.h"
#include "core/scheduler/rejoining.h"
#include "core/scheduler/setting_speed.h"
#include "core/scheduler/waiting/capacity.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/waiting/turns.h"
#include "core/scheduler/ways/approach.h"
#include "core/scheduler/ways/replanning.h"
#include "core/scheduler/weighing.h"
#include "core/scheduler/yielding/making_way.h"

namespace armloom {
namespace {

void note_moved(Transitions& state, const Step& step) {
  const auto* moving = step.in<Moving>();
  if (moving == nullptr) return;
  Moving next = *moving;
  if (is_standing(*state->cell, step, state->now)) {
    next.goes_since = state->now;
    next.goes_from = step.progress;
  }
  next.moved_at = state->now;
  next.was_compared = false;
  state.jobs().set(step, next);
}

// ---- Inputs that concern the shared state alone ----

void take(Transitions& state, const Amend& input) {
  const Step* step = state->jobs.find(input.job);
  if (step == nullptr || step->has_ended()) return;
  const int before = step->job->terms.priority;
  state.amend(*step, input.terms);
  const int priority = step->job->terms.priority;
  if (priority == before) return;
  for (const Step& other : state->jobs.of(state->jobs.active())) {
    if (other.job->errand.on_behalf_of == step->id.job) state.amend(other, {.priority = priority});
  }
}

void take(Transitions& state, const Refused& input) {
  const Step* step = state->jobs.find(input.step);
  if (step == nullptr || step->in<Moving>() == nullptr) return;
  state.brake(*step,
              {.then = AfterStop::Then::decide_again, .detail = input.detail, .arm = input.other});
}

void take(Transitions& state, const Stop& input) {
  state.stop_arms(input);
  compare_again(state);
}

void take(Transitions& state, const Resume& input) {
  for (ArmId arm : input.arms) state.arms().resume(arm);
  for (ArmId arm : input.arms) rejoin(state, arm);
  explain_again(state, input.arms);
}

void take(Transitions& state, const Unlocated& input) {
  state.arms().set_unlocated(input.arm, input.may_meet);
  explain_again(state, input.may_meet);
}

void take(Transitions& state, const Located& input) {
  explain_again(state, state.arms().set_located(input.arm));
  const auto& queue = state->jobs.queues()[input.arm];
  if (!queue.empty() && state->jobs.at(queue.front()).is_in_motion()) return;
  state.locate(input);
  decide_again_beside(state, input.arm);
  rejoin(state, input.arm);
  compare_again(state);
}
void take(Transitions& state, const StartRecorded& input) {
  const Step* step = state->jobs.find(input.step);
  if (step == nullptr) return;
  state.jobs().set(*step, with(*step->job, &Job::awaits_record, false));
  renew_clocks(state, *step, true);
}
void take(Transitions& state, const ActionsDone& input) {
  const Step* step = state->jobs.find(input.job);
  if (step == nullptr || step->has_ended()) return;
  if (input.motion && step->in<Queued>() != nullptr) state.go_by(*step, input.motion);
  state.jobs().set(*step, with(*step->job, &Job::awaits_actions, false));
}
void take(Transitions& state, const SetSpeed& input) { set_speed(state, input); }
void take(Transitions& state, const SetBrake& input) { set_brake(state, input); }

void take(Transitions& state, const SceneChanged& input) {
  std::vector<ArmId> held;
  for (const auto* holds : {&state->around.shared_holds, &input.shared_holds}) {
    for (const SharedHold& hold : *holds)
      held.insert(held.end(), hold.arms.begin(), hold.arms.end());
  }
  state.change_scene(input.shared_holds);
  explain_again(state, held);
  for (const Step& step : state->jobs.past_queue()) {
    const auto is_named = [&](ArmId arm) { return std::ranges::count(input.arms, arm) > 0; };
    if (std::ranges::any_of(step.leg.arms, is_named)) state.jobs().put_in_question(step);
  }
}

void take(Transitions& state, const SignalChanged& input) { state.set_signal(input); }

void take(Transitions& state, const ChangePolicy& input) {
  if (!state->graph.motions().empty()) return;
  state.change_policy(input.policy);
}

void take(Transitions& state, const Interrupt& input) { state.interrupt(input.keeps_waiting); }

void take(Transitions&, const Wake&) {}  // settle() does the work

}  // namespace

Scheduler::Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
                     JobId first)
    : state_(State(std::move(cell), std::move(policy), std::move(rest), first)) {
  if (!state_->policy) throw std::invalid_argument("Scheduler: no policy");
}

Scheduler::Scheduler(CellPtr cell, std::shared_ptr<const Policy> policy, Configuration rest,
                     const std::vector<Motion>& under_way, TimePoint now)
    : Scheduler(std::move(cell), std::move(policy), std::move(rest)) {
  state_.begin(now);
  for (const Motion& motion : under_way) {
    state_.add({.job = motion.step.job, .trajectory = motion.trajectory});
  }
  renew_round(state_);
  std::vector<CoordinatedMotion> admitted;
  for (const Motion& motion : under_way) {
    const Step& step = state_->jobs.at(motion.step);
    state_.measure(step, {motion.step, MotionReport::Kind::progressed, motion.progress});
    admitted.push_back(as_candidate(state_, step));
  }
  state_.put_under_way(under_way, admitted);
}

void Scheduler::on(const Submit& input) {
  Configuration rest = predicted_rest(state_);
  const Step& added = state_.add(input);
  bring_back(state_, input, std::move(rest));
  reopen_turn(state_, added);
}

std::vector<Effect> Scheduler::step(const Input& input, TimePoint now) {
  if (now < state_->now) throw std::invalid_argument("Scheduler: time went backwards");
  state_.begin(now);
  const auto* report = std::get_if<MotionReport>(&input);
  const Version version_before = state_->version();
  std::visit(
      [this](const auto& i) {
        if constexpr (requires { take(state_, i); }) {
          take(state_, i);
        } else {
          on(i);
        }
      },
      input);

  // Progress alone, the bulk of all inputs, changes nothing that others wait for.
  const bool only_progress = report && report->kind == MotionReport::Kind::progressed &&
                             !state_->jobs.updates().has_changed() &&
                             state_->version() == version_before && !is_due();
  if (only_progress) return state_.take_effects();
  settle();
  if (const auto broken = broken_invariant(state_)) throw std::logic_error(*broken);
  return state_.take_effects();
}

// Runs all rules after an input. The comments give the reason for the place of each rule.
void Scheduler::settle() {
  expire_and_overrun(state_);  // first, so that no other rule works for a job that ends now
  see_standing(state_);        // before authority is given, so that no motion passes unchecked
  pass_errands_on(state_);     // before cycles are settled, so that no needless job is in one
  cycles_.settle(state_);   // published in an earlier step; may brake jobs or give them new paths
  plan_other_ways(state_);  // of jobs that the rules above have brought to rest
  weigh_again(state_);      // before authority is given, which fixes orders
  dispatch_ready(state_);
  bool put_off = true;
  while (put_off) {  // until a question is open, or nothing is left to be asked
    do {
      fail_impossible_starts(state_);
    } while (plan_goals(state_));  // a job that fails changes where later jobs begin
    state_.lanes().renew(state_->jobs, state_->arms);  // of the jobs and paths that are left
    renew_round(state_);                               // before waits, which name it
    const Turns turns = explain_waits(state_);
    cycles_.name(state_);  // of these waits
    put_off = admission_.ask_next(state_, turns, cycles_);
  }
  look_ahead();
}

// Returns true if a rule must run although nothing else has happened. If all motions are as
// predicted, the orders need not be chosen again.
bool Scheduler::is_due() {
  if (deadline_ && *deadline_ <= state_->now) return true;
  if (!weighs_at_ || *weighs_at_ > state_->now) return false;
  if (is_off_course(state_)) return true;
  weighs_at_ = weighs_next(state_);
  ask_for_wake();
  return false;
}

void Scheduler::look_ahead() {
  deadline_ = next_deadline(state_);
  if (cycles_.is_one_to_settle()) {
    const TimePoint soon = state_->now + kAfterRingWasTold;
    deadline_ = deadline_ ? std::min(*deadline_, soon) : soon;
  }
  if (const auto stands = stands_next(state_)) {
    deadline_ = deadline_ ? std::min(*deadline_, *stands) : stands;
  }
  weighs_at_ = weighs_next(state_);
  ask_for_wake();
}

void Scheduler::ask_for_wake() {
  std::optional<TimePoint> next = deadline_;
  if (weighs_at_) next = next ? std::min(*next, *weighs_at_) : weighs_at_;
  if (next && next != wake_at_) state_.effect(WakeAt{*next});
  wake_at_ = next;
}

// ---- Inputs ----

void Scheduler::on(const Replan& input) {
  const Step* step = state_->jobs.find(input.job);
  if (step == nullptr || step->has_ended() || why_not_replanned(*step)) return;
  ask_for_another_way(state_, *step, AnotherWay::Cause::client);
}

void Scheduler::on(const Cancel& input) {
  const Step* step = state_->jobs.find(input.job);
  if (step == nullptr || step->has_ended()) return;
  bool brakes = step->has_authority();
  for (JobId approach : approaches_of(state_, *step)) {
    brakes = brakes || state_->jobs.at(approach).has_authority();
  }
  give_up_with_approaches(state_, *step, {.then = AfterStop::Then::cancel});
  if (brakes) compare_again(state_);
}

void Scheduler::on(const MotionReport& input) {
  const Step* step = state_->jobs.find(input.step);
  if (step == nullptr || step->has_ended()) return;
  const Duration before = step->progress;
  state_.measure(*step, input);
  if (input.progress > before) note_moved(state_, *step);
  see_pauses(state_, *step, before);
  if (input.kind == MotionReport::Kind::progressed) {
    if (step->state() == JobState::scheduled) state_.jobs().start(*step, state_->now);
    if (step->in<Moving>() != nullptr) extend_authority(state_, step->id);
  } else {
    const auto* braking = step->in<Braking>();
    const AfterStop after = braking != nullptr ? braking->after : AfterStop{};
    state_.come_to_rest(*step, input);
    const bool is_refused = after.then == AfterStop::Then::decide_again && !after.detail.empty();
    if (is_refused && step->is_waiting()) {
      put_off(state_, *step,
              {{.kind = Wait::Kind::guard, .arm = after.arm, .detail = after.detail}});
    }
    for (ArmId arm : step->trajectory->arms()) rejoin(state_, arm);
    if (input.kind != MotionReport::Kind::finished) compare_again(state_);
  }
}

// ---- Queries ----

bool Scheduler::has_turn_for_actions(JobId job) const {
  const Step* step = find(job);
  return step != nullptr && !step->has_ended() && lacks_only_actions(state_, *step);
}

const Step* Scheduler::find(JobId job) const { return state_->jobs.find(job); }

std::optional<TimePoint> Scheduler::expiry(JobId job) const {
  const Step* found = find(job);
  if (found == nullptr) return std::nullopt;
  const auto expiry = expiry_of(state_, *found);
  return expiry == TimePoint::max() ? std::nullopt : expiry;
}

std::vector<JobId> Scheduler::active() const {
  return {state_->jobs.active().begin(), state_->jobs.active().end()};
}

std::optional<JobId> Scheduler::head(ArmId arm) const {
  const auto& queue = state_->jobs.queues()[arm];
  return queue.empty() ? std::nullopt : std::optional(queue.front().job);
}

std::optional<JobId> Scheduler::occupant(ArmId arm) const {
  const auto& queue = state_->jobs.queues()[arm];
  if (queue.empty()) return std::nullopt;
  const Step& head = state_->jobs.at(queue.front());
  return head.occupies_its_arms() ? std::optional(head.id.job) : std::nullopt;
}

void Scheduler::forget(JobId ended) {
  const Step* step = find(ended);
  if (step != nullptr && step->has_ended()) state_.jobs().forget(ended);
}

std::optional<Duration> Scheduler::earliest_start(const Question& question,
                                                  const Verdict& verdict) const {
  if (verdict.kind != Verdict::Kind::free || question.version != state_->version()) {
    return std::nullopt;
  }
  if (question.candidates.size() != 1) return std::nullopt;
  const std::vector<CoordinatedMotion> candidate{
      as_candidate(state_, state_->jobs.at(question.candidates.front().step))};
  const PassingOrders orders =
      orders_in_time(state_->graph.question(candidate, verdict.regions), std::nullopt);
  if (!orders.blockers.empty()) return std::nullopt;
  return orders.prediction.begins.back();
}

}  // namespace armloom

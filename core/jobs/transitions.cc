#include "core/jobs/transitions.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

using Then = AfterStop::Then;

// Returns true if the job has moved, on any path that it has had.
bool has_begun(const Step& step) { return step.times.started_at.has_value(); }

// Returns the alternative of the arm with the least work.
const TrajectoryPtr& likeliest(const State& state, const Submit& job) {
  if (job.alternatives.empty()) return job.trajectory;
  return *std::ranges::min_element(job.alternatives, {}, [&](const TrajectoryPtr& motion) {
    const auto& queue = state.jobs.queues()[motion->arms().front()];
    Duration work{};
    for (StepId step : queue) work += state.jobs.at(step).trajectory->duration();
    return work;
  });
}

Step step_of(const State& state, const Submit& job, const std::optional<Errand>& errand) {
  if (!job.trajectory) throw std::invalid_argument("Submit: no trajectory");
  const TrajectoryPtr& motion = likeliest(state, job);
  const Duration usual = state.cell->scheduling.backlog_timeout;
  JobTerms terms = job.terms;
  terms.backlog_timeout = job.terms.backlog_timeout.value_or(usual);
  Step step{
      .id = only_step(job.job),
      .job = std::make_shared<Job>(Job{.id = job.job,
                                       .terms = terms,
                                       .after = job.after,
                                       .system_job = job.system_job,
                                       .is_held_over = job.is_held_over,
                                       .awaits_record = job.start_is_recorded,
                                       .task = job.task,
                                       .awaits_actions = job.awaits_actions,
                                       .retries = job.retries,
                                       .turn = job.job,
                                       .errand = errand.value_or(Errand{.on_behalf_of = job.job}),
                                       .submitted_at = state.now}),
      .trajectory = motion,
      .alternatives = job.alternatives,
      .leg = {.step = only_step(job.job), .arms = {}, .from = {}, .to = {}}};
  if (job.goals.empty()) return step;
  JobGoal& goal = step.goal.emplace();
  for (const MotionGoal& one : job.goals) goal.ways.push_back({.goal = one});
  if (!job.alternatives.empty()) {
    const auto taken = std::ranges::find(job.alternatives, motion);
    goal.taken = static_cast<std::size_t>(taken - job.alternatives.begin());
  }
  return step;
}

}  // namespace

const Step& Transitions::add(const Submit& job, const std::optional<Errand>& errand) {
  Step step = step_of(state_, job, errand);
  step.leg = state_.arms.leg_of(*state_.cell, step.id, *step.trajectory);
  const Step& added = state_.jobs.add(std::move(step));
  state_.lanes.add(added, state_.jobs);
  return added;
}

void Transitions::put_under_way(const std::vector<Motion>& motions,
                                const std::vector<CoordinatedMotion>& admitted) {
  for (const Motion& motion : motions) {
    const Step& step = state_.jobs.at(motion.step);
    enter(step, Admitted{});
    enter(step, Moving{.overrun_at = TimePoint::max(), .moved_at = state_.now});
    if (motion.progress > Duration{}) state_.jobs.start(step, state_.now);
  }
  state_.graph.admit(admitted, PassingOrders{});
}

void Transitions::enter(const Step& step, StepPhase phase) {
  const StepPhase before = step.phase;
  state_.jobs.enter(step, std::move(phase));
  state_.lanes.follow(step, before);
}

// Removes the motion, which rests where it is. Withdraws the motions behind it on its arms, because
// they begin where it would have ended.
void Transitions::leave_graph(const Step& step) {
  if (!state_.graph.holds(step.id)) return;
  std::set<StepId> behind;
  for (ArmId arm : step.trajectory->arms()) {
    const auto& queue = state_.jobs.queues()[arm];
    const auto own = std::ranges::find(queue, step.id);
    if (own == queue.end()) continue;
    for (auto next = own + 1; next != queue.end(); ++next) {
      if (state_.graph.holds(*next)) behind.insert(*next);
    }
  }
  for (auto id = behind.rbegin(); id != behind.rend(); ++id) {
    if (state_.graph.holds(*id)) withdraw(state_.jobs.at(*id), {});
  }
  state_.expected.spoil();
  state_.graph.abandon(step.id, step.progress, step.farthest);
}

void Transitions::end_as(const Step& step, const AfterStop& after, const char* canceled) {
  if (after.then == Then::cancel) {
    return end(step, JobState::canceled, Reason::canceled_by_client, canceled);
  }
  const bool expires = after.reason == Reason::backlog_timeout;
  end(step, expires ? JobState::expired : JobState::failed, after.reason, after.detail);
}

// Ends a job whose arms rest at its start, or on its path with the motion not released.
void Transitions::end_at_rest(const Step& step, const AfterStop& after) {
  const bool held = step.has_started();
  end_as(step, after, held ? "canceled while paused" : "canceled before it moved");
  if (held) release(step);
}

// A move to the start that failed or expired is not repeated: another one would fail, too.
void Transitions::refuse_approach(const Step& step, Reason reason, const std::string& why) {
  const bool in_vain = reason == Reason::no_plan || reason == Reason::backlog_timeout;
  if (!in_vain || !step.goal || !step.job->errand.before) return;
  const Step* head = state_.jobs.find(*step.job->errand.before);
  if (head == nullptr) return;
  state_.jobs.set(*head, with(head->approaches, &Approaches::refusal, why));
}

void Transitions::end(const Step& step, JobState how, Reason reason, std::string detail) {
  refuse_approach(step, reason, detail);
  const bool succeeded = how == JobState::succeeded;
  if (succeeded) {
    state_.graph.finish(step.id);
  } else {
    leave_graph(step);
  }
  const StepPhase before = step.phase;
  const auto followers = state_.jobs.end(step, {how, reason, std::move(detail), state_.now});
  state_.lanes.follow(step, before);
  if (succeeded) return;
  for (JobId id : followers) {
    if (!state_.jobs.active().contains(id)) continue;  // failed meanwhile, with another of its own
    end(state_.jobs.at(id), JobState::failed, Reason::predecessor_failed,
        "a job that it comes after did not succeed");
  }
}

void Transitions::interrupt(bool keeps_waiting) {
  const std::vector<JobId> ids(state_.jobs.active().begin(), state_.jobs.active().end());
  std::vector<JobId> ends;
  for (const Step& step : state_.jobs.of(ids)) {
    Job job = *step.job;
    if (keeps_waiting && !has_begun(step)) {
      job.is_held_over = true;
    } else {
      job.after.clear();  // so that it is interrupted, not failed
      ends.push_back(step.id.job);
    }
    state_.jobs.set(step, std::move(job));
  }
  for (const Step& step : state_.jobs.of(ends)) {
    end(step, JobState::interrupted, Reason::server_restart,
        has_begun(step) ? "the server ended while the job was under way"
                        : "the server ended before the job began");
  }
}

void Transitions::give_up(const Step& step, const AfterStop& after) {
  if (step.has_authority()) return brake(step, after);
  end_at_rest(step, after);
}

void Transitions::admit(const std::vector<StepId>& steps,
                        const std::vector<CoordinatedMotion>& candidates,
                        const PassingOrders& orders) {
  state_.lanes.admitted(steps);
  state_.graph.admit(candidates, orders);
  const std::size_t before = state_.graph.motions().size() - steps.size();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = state_.jobs.at(steps[i]);
    if (step.has_open_arm()) state_.jobs.decide_arm(step);
    enter(step, Admitted{});
    state_.jobs.schedule(step, state_.now + orders.prediction.begins[before + i]);
  }
  state_.expected.renew(state_.graph.motions(), orders.prediction, state_.now);
}

void Transitions::readmit(const Step& step) {
  enter(step, Admitted{});
  state_.jobs.schedule(step, state_.now);
}

void Transitions::withdraw(const Step& step, const AfterStop& after) {
  if (after.ends()) return end_at_rest(step, after);
  leave_graph(step);
  if (step.has_started()) {
    enter(step, Held{});
  } else {
    enter(step, Queued{.in_backlog = step.times.backlogged_at.has_value()});
  }
  state_.jobs.schedule(step, std::nullopt);
}

void Transitions::dispatch(const Step& step, const Moving& data, double off_path,
                           Duration authority) {
  state_.graph.granted(step.id, authority);
  state_.jobs.set_off_path(step, off_path);
  enter(step, data);
  state_.jobs.schedule(step, state_.now);
  state_.jobs.set_waits(step, {});
  effect(Dispatch{step.id, state_.now, step.progress, authority});
}

void Transitions::grant(const Step& step, Duration authority) {
  state_.graph.granted(step.id, authority);
  effect(Grant{step.id, authority});
}

void Transitions::measure(const Step& step, const MotionReport& report) {
  state_.jobs.measure(step, report, state_.now);
  state_.graph.progress(report.step, report.progress);
}

void Transitions::brake(const Step& step, AfterStop after) {
  if (step.in<Admitted>() != nullptr) return withdraw(step, after);
  const auto* braking = step.in<Braking>();
  Braking next{.after = after, .state = step.pausing() ? JobState::paused : step.state()};
  if (braking != nullptr && (braking->after.ends() || after.then == Then::hold)) {
    next.after = braking->after;
  }
  if (braking != nullptr) next.rests_at = braking->rests_at;
  if (braking == nullptr) effect(Brake{step.id});
  if (!next.after.ends() && step.has_started()) next.state = JobState::paused;
  enter(step, std::move(next));
}

void Transitions::come_to_rest(const Step& step, const MotionReport& report) {
  state_.arms.come_to_rest(*state_.cell, step.trajectory, report.rest_position);
  const bool moved = std::max(step.progress, report.farthest) > Duration{};
  if (moved) state_.jobs.start(step, state_.now);  // before this was measured
  const auto* braking = step.in<Braking>();
  const AfterStop after = braking != nullptr ? braking->after : AfterStop{};
  if (report.kind == MotionReport::Kind::finished) {
    state_.arms.rest_at_goal(step.leg);
    end(step, JobState::succeeded, Reason::completed, "");
  } else if (report.kind == MotionReport::Kind::faulted) {
    const std::string cause = "fault: " + report.detail;
    for (ArmId arm : step.trajectory->arms()) state_.arms.stop(arm, cause);
    end(step, JobState::failed, Reason::arm_fault, report.detail);
  } else if (after.ends()) {
    end_as(step, after, "braked on its path");
  } else if (step.has_started()) {
    return after.then == Then::hold ? enter(step, Held{}) : withdraw(step, after);
  } else if (after.then == Then::decide_again) {
    withdraw(step, after);
  } else {
    // Its orders still apply. Objects may have come into its way.
    enter(step, Admitted{});
  }
  release(step);
}

void Transitions::stop_arms(const Stop& stop) {
  for (const auto& [arm, cause, until_connected] : stop.arms) {
    state_.arms.stop(arm, cause, until_connected);
    if (state_.jobs.queues()[arm].empty()) continue;
    const Step& step = state_.jobs.at(state_.jobs.queues()[arm].front());
    if (step.in<Moving>() == nullptr) continue;  // undispatched: keeps its place
    brake(step, {});
    state_.jobs.set_wait(step, {.kind = Wait::Kind::stop, .arm = arm, .detail = cause});
  }
}

void Transitions::set_out_anew(const Step& step, TrajectoryPtr way) {
  leave_graph(step);
  if (step.has_started()) release(step);
  enter(step, Queued{});
  state_.jobs.start_over(step);
  go_by(step, std::move(way));
}

void Transitions::go_by(const Step& step, TrajectoryPtr way) {
  WaitingLeg leg = state_.arms.leg_of(*state_.cell, step.id, *way);
  state_.jobs.set_motion(step, std::move(way), std::move(leg));
  state_.lanes.renew_later();
}

void Transitions::take_plan(const Step& step, std::size_t which, const TrajectoryPtr& way) {
  WaitingLeg leg = state_.arms.leg_of(*state_.cell, step.id, *way);
  if (step.has_open_arm()) {
    state_.jobs.set_alternative(step, which, way, std::move(leg));
  } else if (which == step.goal->taken) {
    state_.jobs.set_motion(step, way, std::move(leg));
  }
}

void Transitions::set_planned(const Step& step, bool is_planned) {
  if (state_.jobs.set_planned(step, is_planned)) state_.lanes.renew_later();
}

void Transitions::take_alternative(const Step& step, std::size_t which, std::size_t place) {
  WaitingLeg leg = state_.arms.leg_of(*state_.cell, step.id, *step.alternatives[which]);
  state_.jobs.take(step, which, std::move(leg), place);
  state_.lanes.renew_later();
}

void Transitions::restore(const Step& step, std::uint64_t motion, Lanes lanes) {
  state_.jobs.restore(step, motion);
  state_.lanes = std::move(lanes);
  state_.lanes.renew_later();
}

void Transitions::put_in_order(const std::vector<JobId>& jobs) {
  state_.jobs.put_in_order(jobs);
  state_.lanes.renew_later();
}

void Transitions::amend(const Step& step, const AmendedTerms& terms) {
  const int before = step.job->terms.priority;
  state_.jobs.amend(step, terms);
  const int priority = step.job->terms.priority;
  if (priority == before) return;
  if (state_.graph.holds(step.id)) state_.graph.set_priority(step.id, priority);
  state_.expected.spoil();
}

void Transitions::let_pass(const Step& step, std::optional<JobId> other) {
  Job job = *step.job;
  job.errand.lets_pass = other;
  state_.jobs.set(step, std::move(job));
  state_.lanes.renew_later();
}

}  // namespace armloom

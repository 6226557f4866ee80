#include "core/jobs/phases.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

using Then = AfterStop::Then;

// Its motion is admitted no more: it rests where it is. Nor are those behind it on its arms, which
// begin where it would have ended.
void leave_graph(State& state, const Step& step) {
  if (!state.graph.holds(step.id)) return;
  std::set<StepId> behind;
  for (ArmId arm : step.trajectory->arms()) {
    const auto& queue = state.jobs.queues()[arm];
    const auto own = std::ranges::find(queue, step.id);
    if (own == queue.end()) continue;
    for (auto next = own + 1; next != queue.end(); ++next) {
      if (state.graph.holds(*next)) behind.insert(*next);
    }
  }
  for (auto id = behind.rbegin(); id != behind.rend(); ++id) {
    if (state.graph.holds(*id)) withdraw(state, state.jobs.at(*id), {});
  }
  state.expected.spoil();
  state.graph.abandon(step.id, step.progress, step.farthest);
}

void release(State& state, const Step& step) { state.decided.effects.push_back(Release{step.id}); }

void end_as(State& state, Step& step, const AfterStop& after, const char* canceled) {
  if (after.then == Then::cancel) {
    return end(state, step, JobState::canceled, Reason::canceled_by_client, canceled);
  }
  const bool expires = after.reason == Reason::backlog_timeout;
  end(state, step, expires ? JobState::expired : JobState::failed, after.reason, after.detail);
}

// Its arms stand: where it began, or on its path with the motion still told to them.
void end_at_rest(State& state, Step& step, const AfterStop& after) {
  const bool held = step.has_started();
  end_as(state, step, after, held ? "canceled while paused" : "canceled before it moved");
  if (held) release(state, step);
}

// Stopped before it had moved: it keeps its place between the others, but for objects that have
// come into its way.
void rest_at_start(State& state, Step& step) {
  release(state, step);
  state.jobs.changed(step);
  enter(state, step, Admitted{});
}

// By any way that it has had.
bool has_begun(const Step& step) { return step.times.started_at.has_value(); }

// For the time being with the arm that has least to do.
const TrajectoryPtr& likeliest(const State& state, const Submit& job) {
  if (job.alternatives.empty()) return job.trajectory;
  return *std::ranges::min_element(job.alternatives, {}, [&](const TrajectoryPtr& motion) {
    const auto& queue = state.jobs.queues()[motion->arms().front()];
    Duration work{};
    for (StepId step : queue) work += state.jobs.at(step).trajectory->duration();
    return work;
  });
}

// An approach that could not be made, or has waited in vain: another one would not fare better.
void refuse_approach(State& state, const Step& step, Reason reason, const std::string& why) {
  const bool in_vain = reason == Reason::no_plan || reason == Reason::backlog_timeout;
  if (!in_vain || !step.goal || !step.job->errand.before) return;
  Step* head = state.jobs.find(*step.job->errand.before);
  if (head != nullptr) head->approaches.refusal = why;
}

}  // namespace

Step step_of(State& state, const Submit& job, const std::optional<Errand>& errand) {
  if (!job.trajectory) throw std::invalid_argument("Submit: no trajectory");
  const TrajectoryPtr& motion = likeliest(state, job);
  const StepId id = only_step(job.job);
  const Duration usual = state.cell->scheduling.backlog_timeout;
  JobTerms terms = job.terms;
  terms.backlog_timeout = job.terms.backlog_timeout.value_or(usual);
  Step step{
      .id = id,
      .job = std::make_shared<Job>(Job{.id = job.job,
                                       .terms = terms,
                                       .after = job.after,
                                       .system_job = job.system_job,
                                       .is_held_over = job.is_held_over,
                                       .awaits_record = job.start_is_recorded,
                                       .turn = job.job,
                                       .errand = errand.value_or(Errand{.on_behalf_of = job.job}),
                                       .submitted_at = state.now}),
      .trajectory = motion,
      .alternatives = job.alternatives,
      .leg = state.arms.leg_of(*state.cell, id, *motion)};
  if (job.goals.empty()) return step;
  JobGoal& goal = step.goal.emplace();
  for (const MotionGoal& one : job.goals) goal.ways.push_back({.goal = one});
  if (!job.alternatives.empty()) {
    const auto taken = std::ranges::find(job.alternatives, motion);
    goal.taken = static_cast<std::size_t>(taken - job.alternatives.begin());
  }
  return step;
}

void add(State& state, Step step) { state.lanes.add(state.jobs.add(std::move(step))); }

void enter(State& state, Step& step, StepPhase phase) {
  const StepPhase before = step.phase;
  state.jobs.enter(step, std::move(phase));
  state.lanes.follow(step, before);
}

void end(State& state, Step& step, JobState how, Reason reason, std::string detail) {
  refuse_approach(state, step, reason, detail);
  const bool succeeded = how == JobState::succeeded;
  if (succeeded) {
    state.graph.finish(step.id);
  } else {
    leave_graph(state, step);
  }
  const JobId ended = step.id.job;
  const StepPhase before = step.phase;
  const auto followers = state.jobs.end(step, {how, reason, std::move(detail), state.now});
  state.lanes.follow(step, before);
  for (JobId id : followers) {
    if (!state.jobs.is_active(id)) continue;  // failed meanwhile, with another of its own
    Step& follower = state.jobs.at(id);
    if (std::erase(state.jobs.change(follower).after, ended) == 0 || succeeded) continue;
    end(state, follower, JobState::failed, Reason::predecessor_failed,
        "a job that it comes after did not succeed");
  }
}

void interrupt(State& state, bool keeps_waiting) {
  std::vector<JobId> ids(state.jobs.active().begin(), state.jobs.active().end());
  if (keeps_waiting) {
    const auto kept =
        std::ranges::partition(ids, [&](JobId id) { return has_begun(state.jobs.at(id)); });
    for (JobId id : kept) state.jobs.change(state.jobs.at(id)).is_held_over = true;
    ids.erase(kept.begin(), kept.end());
    std::ranges::sort(ids);
  }
  for (JobId id : ids)
    state.jobs.change(state.jobs.at(id)).after.clear();  // none fails for another's sake
  for (JobId id : ids) {
    Step& step = state.jobs.at(id);
    end(state, step, JobState::interrupted, Reason::server_restart,
        has_begun(step) ? "the server ended while the job was under way"
                        : "the server ended before the job began");
  }
}

void brake(State& state, Step& step, AfterStop after) {
  if (step.in<Admitted>() != nullptr) return withdraw(state, step, after);
  const auto* braking = step.in<Braking>();
  Braking next{.after = after,
               .state = braking != nullptr ? braking->state : step.state(),
               .paused = step.pausing()};
  if (braking != nullptr && braking->after.then != Then::hold) next.after = braking->after;
  if (braking == nullptr) state.decided.effects.push_back(Brake{step.id});
  if (next.after.then == Then::hold && step.has_started()) next.state = JobState::paused;
  enter(state, step, std::move(next));
  state.jobs.changed(step);
}

void withdraw(State& state, Step& step, const AfterStop& after) {
  if (after.then != Then::hold) return end_at_rest(state, step, after);
  leave_graph(state, step);
  if (step.has_started()) {
    enter(state, step, Held{});
  } else {
    enter(state, step, Queued{.in_backlog = step.times.backlogged_at.has_value()});
  }
  step.times.scheduled_at.reset();
  state.jobs.changed(step);
}

void come_to_rest(State& state, Step& step, const MotionReport& report) {
  state.arms.come_to_rest(*state.cell, step.trajectory, report.rest_position);
  const bool moved = std::max(step.progress, report.farthest) > Duration{};
  if (moved) step.note_start(state.now);  // unseen
  step.farthest = report.farthest;
  const auto* braking = step.in<Braking>();
  const AfterStop after = braking != nullptr ? braking->after : AfterStop{};
  if (report.kind == MotionReport::Kind::finished) {
    state.arms.rest_at_goal(step.leg);
    end(state, step, JobState::succeeded, Reason::completed, "");
  } else if (report.kind == MotionReport::Kind::faulted) {
    const std::string cause = "fault: " + report.detail;
    for (ArmId arm : step.trajectory->arms()) state.arms.stop(arm, cause);
    end(state, step, JobState::failed, Reason::arm_fault, report.detail);
  } else if (after.then != Then::hold) {
    end_as(state, step, after, "braked on its path");
  } else if (!step.has_started()) {
    return rest_at_start(state, step);
  } else {
    enter(state, step, Held{});
    state.jobs.changed(step);
    return;
  }
  release(state, step);
}

void set_out_anew(State& state, Step& step, TrajectoryPtr way) {
  leave_graph(state, step);
  if (step.has_started()) release(state, step);
  enter(state, step, Queued{});
  step.times.backlogged_at.reset();
  step.times.scheduled_at.reset();
  step.times.motion_started_at.reset();
  step.progress = Duration{};
  step.farthest = Duration{};
  go_by(state, step, std::move(way));
}

void go_by(State& state, Step& step, TrajectoryPtr way) {
  WaitingLeg leg = state.arms.leg_of(*state.cell, step.id, *way);
  state.jobs.set_motion(step, std::move(way), std::move(leg));
  state.lanes.renew_later();
}

void give_up(State& state, Step& step, const AfterStop& after) {
  if (step.has_authority()) return brake(state, step, after);
  end_at_rest(state, step, after);
}

void stop_arms(State& state, const Stop& stop) {
  for (const auto& [arm, cause, until_connected] : stop.arms) {
    state.arms.stop(arm, cause, until_connected);
    if (state.jobs.queues()[arm].empty()) continue;
    Step& step = state.jobs.at(state.jobs.queues()[arm].front());
    if (step.in<Moving>() == nullptr) continue;  // undispatched: keeps its place
    brake(state, step, {});
    state.jobs.set_wait(step, {.kind = Wait::Kind::stop, .arm = arm, .detail = cause});
  }
}

}  // namespace armloom

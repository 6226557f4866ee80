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
void leave_graph(State& state, const Record& record) {
  if (!state.graph.holds(record.job.step())) return;
  std::set<StepId> behind;
  for (ArmId arm : record.job.trajectory->arms()) {
    const auto& queue = state.jobs.queues()[arm];
    const auto own = std::ranges::find(queue, record.job.step());
    if (own == queue.end()) continue;
    for (auto next = own + 1; next != queue.end(); ++next) {
      if (state.graph.holds(*next)) behind.insert(*next);
    }
  }
  for (auto step = behind.rbegin(); step != behind.rend(); ++step) {
    if (state.graph.holds(*step)) withdraw(state, state.jobs.at(*step), {});
  }
  state.expected.spoil();
  state.graph.abandon(record.job.step(), record.job.progress, record.farthest);
}

void release(State& state, const Job& job) { state.decided.effects.push_back(Release{job.step()}); }

void end_as(State& state, Record& record, const AfterStop& after, const char* canceled) {
  if (after.then == Then::cancel) {
    return end(state, record, JobState::canceled, Reason::canceled_by_client, canceled);
  }
  const bool expires = after.reason == Reason::backlog_timeout;
  end(state, record, expires ? JobState::expired : JobState::failed, after.reason, after.detail);
}

// Its arms stand: where it began, or on its path with the motion still told to them.
void end_at_rest(State& state, Record& record, const AfterStop& after) {
  const bool held = record.job.has_started();
  end_as(state, record, after, held ? "canceled while paused" : "canceled before it moved");
  if (held) release(state, record.job);
}

// Stopped before it had moved: it keeps its place between the others, but for objects that have
// come into its way.
void rest_at_start(State& state, Record& record) {
  release(state, record.job);
  state.jobs.changed(record);
  enter(state, record, Admitted{});
}

// By any way that it has had.
bool has_begun(const Job& job) { return job.times.started_at.has_value(); }

// For the time being with the arm that has least to do.
const TrajectoryPtr& likeliest(const State& state, const Submit& job) {
  if (job.alternatives.empty()) return job.trajectory;
  return *std::ranges::min_element(job.alternatives, {}, [&](const TrajectoryPtr& motion) {
    const auto& queue = state.jobs.queues()[motion->arms().front()];
    Duration work{};
    for (StepId step : queue) work += state.jobs.at(step).job.trajectory->duration();
    return work;
  });
}

// An approach that could not be made, or has waited in vain: another one would not fare better.
void refuse_approach(State& state, const Record& record, Reason reason, const std::string& why) {
  const bool in_vain = reason == Reason::no_plan || reason == Reason::backlog_timeout;
  if (!in_vain || !record.job.goal || !record.errand.before) return;
  Record* head = state.jobs.find(*record.errand.before);
  if (head != nullptr) head->approaches.refusal = why;
}

}  // namespace

Record record_of(State& state, const Submit& job) {
  if (!job.trajectory) throw std::invalid_argument("Submit: no trajectory");
  const TrajectoryPtr& motion = likeliest(state, job);
  Record record{.job = {.id = job.job,
                        .trajectory = motion,
                        .terms = job.terms,
                        .after = job.after,
                        .system_job = job.system_job,
                        .is_held_over = job.is_held_over,
                        .awaits_record = job.start_is_recorded,
                        .alternatives = job.alternatives},
                .leg = state.arms.leg_of(*state.cell, only_step(job.job), *motion),
                .turn = job.job,
                .errand = {.on_behalf_of = job.job}};
  const Duration usual = state.cell->scheduling.backlog_timeout;
  record.job.terms.backlog_timeout = job.terms.backlog_timeout.value_or(usual);
  record.job.times.submitted_at = state.now;
  if (job.goals.empty()) return record;
  JobGoal& goal = record.job.goal.emplace();
  for (const MotionGoal& one : job.goals) goal.ways.push_back({.goal = one});
  if (!job.alternatives.empty()) {
    const auto taken = std::ranges::find(job.alternatives, motion);
    goal.taken = static_cast<std::size_t>(taken - job.alternatives.begin());
  }
  return record;
}

void add(State& state, Record record) { state.lanes.add(state.jobs.add(std::move(record))); }

void enter(State& state, Record& record, JobPhase phase) {
  const JobPhase before = record.job.phase;
  state.jobs.enter(record, std::move(phase));
  state.lanes.follow(record.job, before);
}

void end(State& state, Record& record, JobState how, Reason reason, std::string detail) {
  refuse_approach(state, record, reason, detail);
  const bool succeeded = how == JobState::succeeded;
  if (succeeded) {
    state.graph.finish(record.job.step());
  } else {
    leave_graph(state, record);
  }
  const JobId ended = record.job.id;
  const JobPhase before = record.job.phase;
  const auto followers = state.jobs.end(record, {how, reason, std::move(detail), state.now});
  state.lanes.follow(record.job, before);
  ++state.version;
  for (JobId id : followers) {
    if (!state.jobs.is_active(id)) continue;  // failed meanwhile, with another of its own
    Record& follower = state.jobs.at(id);
    if (std::erase(follower.job.after, ended) == 0 || succeeded) continue;
    end(state, follower, JobState::failed, Reason::predecessor_failed,
        "a job that it comes after did not succeed");
  }
}

void interrupt(State& state, bool keeps_waiting) {
  std::vector<JobId> ids(state.jobs.active().begin(), state.jobs.active().end());
  if (keeps_waiting) {
    const auto kept =
        std::ranges::partition(ids, [&](JobId id) { return has_begun(state.jobs.at(id).job); });
    for (JobId id : kept) state.jobs.at(id).job.is_held_over = true;
    ids.erase(kept.begin(), kept.end());
    std::ranges::sort(ids);
  }
  for (JobId id : ids) state.jobs.at(id).job.after.clear();  // none fails for another's sake
  for (JobId id : ids) {
    Record& record = state.jobs.at(id);
    end(state, record, JobState::interrupted, Reason::server_restart,
        has_begun(record.job) ? "the server ended while the job was under way"
                              : "the server ended before the job began");
  }
}

void brake(State& state, Record& record, AfterStop after) {
  Job& job = record.job;
  if (job.in<Admitted>() != nullptr) return withdraw(state, record, after);
  const auto* braking = job.in<Braking>();
  Braking next{.after = after,
               .state = braking != nullptr ? braking->state : job.state(),
               .paused = job.pausing()};
  if (braking != nullptr && braking->after.then != Then::hold) next.after = braking->after;
  if (braking == nullptr) {
    ++state.version;
    state.decided.effects.push_back(Brake{job.step()});
  }
  if (next.after.then == Then::hold && job.has_started()) next.state = JobState::paused;
  enter(state, record, std::move(next));
  state.jobs.changed(record);
}

void withdraw(State& state, Record& record, const AfterStop& after) {
  ++state.version;  // others may have counted on its departure
  Job& job = record.job;
  if (after.then != Then::hold) return end_at_rest(state, record, after);
  leave_graph(state, record);
  if (job.has_started()) {
    enter(state, record, Held{});
  } else {
    enter(state, record, Queued{.in_backlog = job.times.backlogged_at.has_value()});
  }
  job.times.scheduled_at.reset();
  state.jobs.changed(record);
}

void come_to_rest(State& state, Record& record, const MotionReport& report) {
  Job& job = record.job;
  state.arms.come_to_rest(*state.cell, job.trajectory, report.rest_position);
  ++state.version;
  const bool moved = std::max(job.progress, report.farthest) > Duration{};
  if (moved) job.note_start(state.now);  // unseen
  record.farthest = report.farthest;
  const auto* braking = job.in<Braking>();
  const AfterStop after = braking != nullptr ? braking->after : AfterStop{};
  if (report.kind == MotionReport::Kind::finished) {
    state.arms.rest_at_goal(record.leg);
    end(state, record, JobState::succeeded, Reason::completed, "");
  } else if (report.kind == MotionReport::Kind::faulted) {
    const std::string cause = "fault: " + report.detail;
    for (ArmId arm : job.trajectory->arms()) state.arms.stop(arm, cause);
    end(state, record, JobState::failed, Reason::arm_fault, report.detail);
  } else if (after.then != Then::hold) {
    end_as(state, record, after, "braked on its path");
  } else if (!job.has_started()) {
    return rest_at_start(state, record);
  } else {
    enter(state, record, Held{});
    state.jobs.changed(record);
    return;
  }
  release(state, job);
}

void set_out_anew(State& state, Record& record, TrajectoryPtr way) {
  Job& job = record.job;
  leave_graph(state, record);
  if (job.has_started()) release(state, job);
  enter(state, record, Queued{});
  job.times.backlogged_at.reset();
  job.times.scheduled_at.reset();
  job.times.motion_started_at.reset();
  job.progress = Duration{};
  record.farthest = Duration{};
  go_by(state, record, std::move(way));
}

void go_by(State& state, Record& record, TrajectoryPtr way) {
  WaitingLeg leg = state.arms.leg_of(*state.cell, record.job.step(), *way);
  state.jobs.set_motion(record, std::move(way), std::move(leg));
  state.lanes.renew_later();
  ++state.version;
}

void give_up(State& state, Record& record, const AfterStop& after) {
  if (record.job.has_authority()) return brake(state, record, after);
  end_at_rest(state, record, after);
}

void stop_arms(State& state, const Stop& stop) {
  ++state.version;  // an answer that is under way shall start nothing on these arms
  for (const auto& [arm, cause, until_connected] : stop.arms) {
    state.arms.stop(arm, cause, until_connected);
    if (state.jobs.queues()[arm].empty()) continue;
    Record& record = state.jobs.at(state.jobs.queues()[arm].front());
    if (record.job.in<Moving>() == nullptr) continue;  // undispatched: keeps its place
    brake(state, record, {});
    state.jobs.set_wait(record, {.kind = Wait::Kind::stop, .arm = arm, .detail = cause});
  }
}

}  // namespace armloom

#include "core/scheduler/ways/approach.h"

#include <algorithm>
#include <utility>

#include "core/jobs/phases.h"
#include "core/jobs/standing.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/ways/goals.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

bool send_to_start(State& state, Record& head, ArmId arm) {
  Configuration at = state.arms.rest();
  set_joints(at, *head.job.trajectory, head.job.trajectory->start());
  const auto& joints = state.cell->arm(arm).joints;
  const Eigen::VectorXd to = joints_of(at, joints);
  const double speed = std::min(kApproachSpeed, state.cell->execution.velocity_scaling_factor);
  // An estimate until the path is planned.
  TrajectoryPtr way =
      line_or_stay(*state.cell, joints, joints_of(state.arms.rest(), joints), to, speed);
  if (!way) return false;
  Record record = record_of(state, {.job = state.jobs.next_id(),
                                    .trajectory = std::move(way),
                                    .terms = {.priority = head.job.terms.priority,
                                              .backlog_timeout = head.job.terms.backlog_timeout,
                                              .on_timeout = head.job.terms.on_timeout},
                                    .goals = {{.arm = arm, .to = to, .speed = speed}},
                                    .system_job = true});
  record.errand.on_behalf_of = head.errand.on_behalf_of;
  record.errand.before = head.job.id;
  const JobId id = record.job.id;
  add(state, std::move(record));
  state.decided.sent_aside.push_back(
      {.job = id, .arm = arm, .blocked_job = head.job.id, .to_start = true});
  return true;
}

// Whether its arms are, or may be. It is the first of these, waits, and does not begin where they
// stand.
bool goes_to_start(State& state, Record& head) {
  if (!head.is_brought_to_start() || head.approaches.refusal ||
      head.approaches.tries >= kApproachesMax)
    return false;
  if (head.approaches.feasibility == Approaches::Feasibility::unknown) {
    head.approaches.feasibility = Approaches::Feasibility::in_question;
    state.jobs.explain(head);
    return true;
  }
  ++head.approaches.tries;
  const std::vector<ArmId> arms = head.job.trajectory->arms();
  bool goes = false;
  for (ArmId arm : arms) {
    if (!state.arms.begins_elsewhere(*state.cell, *head.job.trajectory, arm)) continue;
    goes = send_to_start(state, head, arm) || goes;
  }
  return goes;
}

}  // namespace

std::optional<JobId> next_in_question(const State& state) {
  for (const auto& queue : state.jobs.queues()) {
    if (queue.empty()) continue;
    const Record& head = state.jobs.at(queue.front());
    if (head.approaches.are_in_question() && is_at_head(state, head)) return head.job.id;
  }
  return std::nullopt;
}

std::vector<JobId> approaches_of(const State& state, const Record& record) {
  std::vector<JobId> approaches;
  if (record.approaches.tries == 0) return approaches;
  for (ArmId arm : record.job.trajectory->arms()) {
    for (StepId step : state.jobs.queues()[arm]) {
      const Record& own = state.jobs.at(step);
      if (own.errand.before == record.job.id && own.job.system_job && own.job.goal)
        approaches.push_back(own.job.id);
    }
  }
  return approaches;
}

std::optional<JobId> approached_job(const State& state, JobId approach) {
  const Record& own = state.jobs.at(approach);
  if (!own.errand.before || !state.jobs.is_active(*own.errand.before)) return std::nullopt;
  const std::vector<JobId> all = approaches_of(state, state.jobs.at(*own.errand.before));
  return std::ranges::find(all, approach) != all.end() ? own.errand.before : std::nullopt;
}

void keep_those_behind(State& state, const Record& record) {
  for (ArmId arm : record.job.trajectory->arms()) {
    const auto next = state.jobs.queues().behind(record.job, arm);
    if (next) state.jobs.at(*next).approaches.after_deadlock = true;
  }
  state.lanes.renew_later();
}

// The end of a job of several arms gives each of them a new head: hence until there are none.
void fail_impossible_starts(State& state) {
  const auto arms = static_cast<std::uint32_t>(state.cell->arms.size());
  for (std::uint32_t unchanged = 0, arm = 0; unchanged < arms; arm = (arm + 1) % arms) {
    ++unchanged;
    const auto& queue = state.jobs.queues()[ArmId{arm}];
    if (queue.empty()) continue;
    Record& head = state.jobs.at(queue.front());
    const Job& job = head.job;
    if (!job.is_waiting() || job.has_started() || !is_at_head(state, head)) continue;
    if (job.goal) continue;  // its way begins where the arm stands
    if (head.approaches.are_in_question() || may_go_first(state, head)) continue;
    if (job.is_held_over && state.arms.stop_of(job)) continue;
    auto mismatch = state.arms.start_mismatch(*state.cell, *job.trajectory);
    if (!mismatch) continue;
    unchanged = 0;
    if (begins_on_other_arm(state, head) || goes_to_start(state, head)) continue;
    if (head.approaches.refusal) {
      *mismatch += "; no path to its start: " + *head.approaches.refusal;
    }
    if (head.approaches.after_deadlock) keep_those_behind(state, head);
    end(state, head, JobState::failed, Reason::start_mismatch, std::move(*mismatch));
  }
}

}  // namespace armloom

#include "core/scheduler/ways/approach.h"

#include <algorithm>
#include <utility>

#include "core/jobs/standing.h"
#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/ways/goals.h"
#include "core/scheduler/yielding/making_way.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

bool send_to_start(Transitions& state, const Step& head, ArmId arm) {
  Configuration at = state->arms.rest();
  set_joints(at, *head.trajectory, head.trajectory->start());
  const auto& joints = state->cell->arm(arm).joints;
  const Eigen::VectorXd to = joints_of(at, joints);
  const double speed = std::min(kApproachSpeed, state->cell->execution.velocity_scaling_factor);
  // An estimate until the path is planned.
  TrajectoryPtr way =
      line_or_stay(*state->cell, joints, joints_of(state->arms.rest(), joints), to, speed);
  if (!way) return false;
  Submit job{.trajectory = std::move(way),
             .terms = {.backlog_timeout = head.job->terms.backlog_timeout,
                       .on_timeout = head.job->terms.on_timeout}};
  job.goals.push_back({.arm = arm, .to = to, .speed = speed});
  const YieldMove told{.arm = arm, .blocked_job = head.id.job, .to_start = true};
  (void)add_own(state, told, std::move(job), head.id.job);
  return true;
}

// Sends the job's arms to its start, or has this checked first. Returns false if the job must fail.
// Precondition: the job is the first of its arms, waits, and begins elsewhere.
bool goes_to_start(Transitions& state, const Step& head) {
  if (!head.is_brought_to_start() || head.approaches.refusal ||
      head.approaches.tries >= kApproachesMax)
    return false;
  using Feasibility = Approaches::Feasibility;
  if (head.approaches.feasibility == Feasibility::unknown) {
    state.jobs().set(head,
                     with(head.approaches, &Approaches::feasibility, Feasibility::in_question));
    return true;
  }
  state.jobs().set(head, with(head.approaches, &Approaches::tries, head.approaches.tries + 1));
  const std::vector<ArmId> arms = head.trajectory->arms();
  const auto moves_alone = [&](ArmId arm) { return !is_in(arm, state->around.shared_holds); };
  if (!std::ranges::all_of(arms, moves_alone)) return false;
  bool goes = false;
  for (ArmId arm : arms) {
    if (!state->arms.begins_elsewhere(*state->cell, *head.trajectory, arm)) continue;
    goes = send_to_start(state, head, arm) || goes;
  }
  return goes;
}

}  // namespace

std::optional<JobId> next_in_question(const State& state) {
  for (const Step& head : state.jobs.heads()) {
    if (head.approaches.are_in_question() && is_at_head(state, head)) return head.id.job;
  }
  return std::nullopt;
}

std::vector<JobId> approaches_of(const State& state, const Step& step) {
  std::vector<JobId> approaches;
  if (step.approaches.tries == 0) return approaches;
  for (ArmId arm : step.trajectory->arms()) {
    for (const Step& own : state.jobs.of(state.jobs.queues()[arm])) {
      if (own.job->errand.before == step.id.job && own.job->system_job && own.goal)
        approaches.push_back(own.id.job);
    }
  }
  return approaches;
}

void give_up_with_approaches(Transitions& state, const Step& step, const AfterStop& after) {
  for (JobId approach : approaches_of(state, step)) state.give_up(state->jobs.at(approach), after);
  state.give_up(step, after);
}

std::optional<JobId> approached_job(const State& state, JobId approach) {
  const Step& own = state.jobs.at(approach);
  if (!own.job->errand.before || !state.jobs.active().contains(*own.job->errand.before))
    return std::nullopt;
  const std::vector<JobId> all = approaches_of(state, state.jobs.at(*own.job->errand.before));
  return std::ranges::find(all, approach) != all.end() ? own.job->errand.before : std::nullopt;
}

void keep_those_behind(Transitions& state, const Step& step) {
  for (ArmId arm : step.trajectory->arms()) {
    const auto next = state->jobs.queues().behind(step, arm);
    if (!next) continue;
    const Step& behind = state->jobs.at(*next);
    state.jobs().set(behind, with(behind.approaches, &Approaches::after_deadlock, true));
  }
  state.lanes().renew_later();
}

// The end of a job of several arms gives each arm a new first job, so this repeats until none ends.
void fail_impossible_starts(Transitions& state) {
  const auto arms = static_cast<std::uint32_t>(state->cell->arms.size());
  for (std::uint32_t unchanged = 0, arm = 0; unchanged < arms; arm = (arm + 1) % arms) {
    ++unchanged;
    const auto& queue = state->jobs.queues()[ArmId{arm}];
    if (queue.empty()) continue;
    const Step& head = state->jobs.at(queue.front());
    if (!head.is_waiting() || head.has_started()) continue;
    if (head.goal) continue;  // its way begins where the arm stands
    auto mismatch = state->arms.start_mismatch(*state->cell, *head.trajectory);
    if (!mismatch) continue;  // asked first, because most jobs end here
    if (!is_at_head(state, head) || any_closed(state, head, defers_start)) continue;
    if (head.approaches.are_in_question() || may_go_first(state, head)) continue;
    if (head.job->is_held_over && state->arms.stop_of(head)) continue;
    unchanged = 0;
    if (begins_on_other_arm(state, head) || goes_to_start(state, head)) continue;
    if (head.approaches.refusal) {
      *mismatch += "; no path to its start: " + *head.approaches.refusal;
    }
    if (head.approaches.after_deadlock) keep_those_behind(state, head);
    state.end(head, JobState::failed, Reason::start_mismatch, std::move(*mismatch));
  }
}

}  // namespace armloom

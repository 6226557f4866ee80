#include "core/scheduler/approach.h"

#include <utility>

#include "core/scheduler/phases.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// How long it may take: the straight line at that speed is the planner's to make.
TrajectoryPtr estimate(const State& state, ArmId id, const Eigen::VectorXd& to) {
  const auto& joints = state.cell->arm(id).joints;
  auto line = joint_line(*state.cell, joints, joints_of(state.arms.rest(), joints), to);
  if (!line) line = joint_line(*state.cell, joints, to, to);  // it stands outside its limits
  return line ? *line : nullptr;
}

bool send_to_start(State& state, Record& head, ArmId arm) {
  Configuration at = state.arms.rest();
  set_joints(at, *head.job.trajectory, head.job.trajectory->start());
  const Eigen::VectorXd to = joints_of(at, state.cell->arm(arm).joints);
  TrajectoryPtr way = estimate(state, arm, to);
  if (!way) return false;
  Record record = record_of(state, {.job = state.jobs.next_id(),
                                    .trajectory = std::move(way),
                                    .priority = head.job.priority,
                                    .backlog_timeout = head.job.backlog_timeout,
                                    .system_job = true,
                                    .goals = {{.arm = arm, .to = to, .speed = kApproachSpeed}}});
  record.on_behalf_of = head.on_behalf_of;
  record.before = head.job.id;
  const JobId id = record.job.id;
  add(state, std::move(record));
  state.sent_aside.push_back({.job = id, .arm = arm, .blocked_job = head.job.id, .to_start = true});
  return true;
}

}  // namespace

bool goes_to_start(State& state, Record& head) {
  if (!head.job.approaches || head.no_approach || head.approaches >= kApproachesMax) return false;
  ++head.approaches;
  const std::vector<ArmId> arms = head.job.trajectory->arms();
  bool goes = false;
  for (ArmId arm : arms) {
    if (!state.arms.begins_elsewhere(*state.cell, *head.job.trajectory, arm)) continue;
    goes = send_to_start(state, head, arm) || goes;
  }
  return goes;
}

std::vector<JobId> approaches_of(const State& state, const Record& record) {
  std::vector<JobId> approaches;
  for (ArmId arm : record.job.trajectory->arms()) {
    for (JobId id : state.jobs.queue(arm)) {
      const Record& own = state.jobs.at(id);
      if (own.before == record.job.id && own.job.system_job && own.job.goal)
        approaches.push_back(id);
    }
  }
  return approaches;
}

}  // namespace armloom

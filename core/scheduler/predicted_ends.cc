// Where arms will be when their accepted jobs have ended (Scheduler::predicted_rest(),
// open_ends()).
#include "core/scheduler/scheduler.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Returns the phase of a job that brakes and then ends; null if it goes on to its goal.
const Braking* ends_by_braking(const Step& step) {
  const auto* braking = step.in<Braking>();
  return braking != nullptr && braking->after.then != AfterStop::Then::hold ? braking : nullptr;
}

}  // namespace

// The last job of an arm says where it ends.
Configuration Scheduler::predicted_rest() const {
  Configuration q = rest();
  for (std::uint32_t arm = 0; arm < state_->cell->arms.size(); ++arm) {
    const auto& queue = state_->jobs.queues()[ArmId{arm}];
    if (queue.empty()) continue;
    const Step& last = state_->jobs.at(queue.back());
    const Braking* braking = ends_by_braking(last);
    if (braking == nullptr || !braking->rests_at) {
      follow_to_end(q, *state_->cell, ArmId{arm}, *last.trajectory);
      continue;
    }
    Eigen::VectorXd stop;
    last.trajectory->sample_positions(*braking->rests_at, stop);
    set_joints_of(q, *state_->cell, ArmId{arm}, *last.trajectory, stop);
  }
  return q;
}

std::vector<ArmId> Scheduler::open_ends() const {
  std::vector<ArmId> open;
  for (std::uint32_t arm = 0; arm < state_->cell->arms.size(); ++arm) {
    const auto& queue = state_->jobs.queues()[ArmId{arm}];
    if (queue.empty()) continue;
    const Step& last = state_->jobs.at(queue.back());
    const bool is_pose = last.goal && std::holds_alternative<LinkTarget>(last.goal->way().goal.to);
    const Braking* braking = ends_by_braking(last);
    const bool is_stop_unknown = braking != nullptr && !braking->rests_at;
    if (is_stop_unknown || (is_pose && last.is_unplanned())) open.push_back(ArmId{arm});
  }
  for (JobId id : state_->jobs.undecided()) {
    const Step& step = state_->jobs.at(id);
    if (!step.goal) continue;
    for (const GoalWay& way : step.goal->ways) open.push_back(way.goal.arm);
  }
  return open;
}

}  // namespace armloom

#include "core/jobs/queue_ends.h"

#include "core/trajectory/set_joints.h"

namespace armloom {

Configuration predicted_rest(const State& state) {
  Configuration q = state.arms.rest();
  for (std::uint32_t arm = 0; arm < state.cell->arms.size(); ++arm) {
    const auto& queue = state.jobs.queues()[ArmId{arm}];
    if (queue.empty()) continue;
    const Step& last = state.jobs.at(queue.back());
    const Braking* braking = last.ends_by_braking();
    if (braking == nullptr || !braking->rests_at) {
      follow_to_end(q, *state.cell, ArmId{arm}, *last.trajectory);
      continue;
    }
    Eigen::VectorXd stop;
    last.trajectory->sample_positions(*braking->rests_at, stop);
    set_joints_of(q, *state.cell, ArmId{arm}, *last.trajectory, stop);
  }
  return q;
}

std::vector<ArmId> open_ends(const State& state) {
  std::vector<ArmId> open;
  for (std::uint32_t arm = 0; arm < state.cell->arms.size(); ++arm) {
    const auto& queue = state.jobs.queues()[ArmId{arm}];
    if (queue.empty()) continue;
    const Step& last = state.jobs.at(queue.back());
    const bool is_pose = last.goal && std::holds_alternative<LinkTarget>(last.goal->way().goal.to);
    const Braking* braking = last.ends_by_braking();
    const bool is_stop_unknown = braking != nullptr && !braking->rests_at;
    if (is_stop_unknown || (is_pose && last.is_unplanned())) open.push_back(ArmId{arm});
  }
  for (const Step& step : state.jobs.of(state.jobs.active().undecided())) {
    if (!step.goal) continue;
    for (const GoalWay& way : step.goal->ways) open.push_back(way.goal.arm);
  }
  return open;
}

}  // namespace armloom

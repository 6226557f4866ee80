#include "core/jobs/ways_back.h"

#include <utility>

#include "core/trajectory/joint_line.h"
#include "core/trajectory/joints_elsewhere.h"
#include "core/trajectory/set_joints.h"

namespace armloom {

void WaysBack::retreat(ArmId arm, const Trajectory& way) { by_arm_.emplace(arm, retraced(way)); }

std::vector<TrajectoryPtr> WaysBack::take(const Cell& cell, const Trajectory& motion,
                                          Configuration& rest) {
  std::vector<TrajectoryPtr> returns;
  for (ArmId arm : motion.arms()) {
    const auto back = by_arm_.find(arm);
    if (back == by_arm_.end()) continue;
    TrajectoryPtr& way = back->second;
    if (!joints_elsewhere(cell, *way, rest).empty()) {  // it retreated again, or was stopped on it
      const Eigen::VectorXd from = joints_of(rest, way->joints());
      if (auto line = joint_line(cell, way->joints(), from, way->goal())) way = *line;
    }
    Configuration returned = rest, ends = rest;
    set_joints(returned, *way, way->goal());
    set_joints(ends, motion, motion.goal());
    const auto& own = cell.arm(arm).joints;
    const auto here = joints_elsewhere(cell, motion, rest);
    if (joints_elsewhere(cell, motion, returned).size() < here.size()) {
      rest = std::move(returned);
      returns.push_back(std::move(way));
    } else if (joints_elsewhere(cell, own, joints_of(ends, own), rest).empty()) {
      continue;  // only its gripper moves
    }
    by_arm_.erase(back);
  }
  return returns;
}

}  // namespace armloom

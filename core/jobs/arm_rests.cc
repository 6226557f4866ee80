#include "core/jobs/arm_rests.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "core/base/rounding_noise.h"
#include "core/base/whole_turns.h"
#include "core/trajectory/joint_line.h"
#include "core/trajectory/joints_elsewhere.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
ArmRests::ArmRests(const Cell& cell, Configuration rest)
    : rest_(std::move(rest)),
      stopped_(cell.arms.size()),
      came_by_(cell.arms.size()),
      places_at_(cell.arms.size()) {
  if (rest_.size() != static_cast<Eigen::Index>(cell.joints.size())) {
    throw std::invalid_argument(
        "Scheduler: the size of rest differs from the number of joints of the cell");
  }
  for (std::uint32_t arm = 0; arm < places_at_.size(); ++arm) {
    places_at_[arm] = places_.of(ArmId{arm}, joints_of(rest_, cell.arm(ArmId{arm}).joints));
  }
}

void ArmRests::come_to_rest(const Cell& cell, const TrajectoryPtr& motion,
                            const Eigen::VectorXd& position) {
  set_joints(rest_, *motion, position);
  const bool alone = motion->arms().size() == 1;
  for (ArmId arm : motion->arms()) {
    places_at_[arm.index()] = places_.of(arm, joints_of(rest_, cell.arm(arm).joints));
    came_by_[arm.index()] = alone ? motion : nullptr;
  }
  ++changes_;
}

void ArmRests::locate(const Cell& cell, ArmId arm, const Eigen::VectorXd& position) {
  set_joints(rest_, joints_and_gripper(cell.arm(arm)), position);
  places_at_[arm.index()] = places_.of(arm, joints_of(rest_, cell.arm(arm).joints));
  came_by_[arm.index()] = nullptr;
  ++changes_;
}

void ArmRests::set_unlocated(ArmId arm, std::vector<ArmId> may_meet) {
  (void)set_located(arm);
  if (!may_meet.empty()) may_meet_.emplace(arm, std::move(may_meet));
  ++changes_;
}

std::vector<ArmId> ArmRests::set_located(ArmId arm) {
  auto known = may_meet_.extract(arm);
  if (known.empty()) return {};
  ++changes_;
  return std::move(known.mapped());
}

std::optional<ArmId> ArmRests::unlocated_beside(ArmId arm) const {
  for (const auto& [other, may_meet] : may_meet_) {
    if (std::ranges::count(may_meet, arm) > 0) return other;
  }
  return std::nullopt;
}

void ArmRests::rest_at_goal(const WaitingLeg& leg) {
  for (std::size_t i = 0; i < leg.arms.size(); ++i) places_at_[leg.arms[i].index()] = leg.to[i];
}

void ArmRests::stop(ArmId arm, std::string cause, bool until_connected) {
  std::optional<StopOfArm>& stop = stopped_[arm.index()];
  if (stop && (!stop->until_connected || until_connected)) return;
  stop = {std::move(cause), until_connected};
  ++changes_;
}

void ArmRests::resume(ArmId arm) {
  if (stopped_[arm.index()]) ++changes_;
  stopped_[arm.index()].reset();
}

std::optional<Wait> ArmRests::stop_of(const Step& step) const {
  for (ArmId arm : step.trajectory->arms()) {
    const auto& stop = stopped_[arm.index()];
    if (stop) return Wait{.kind = Wait::Kind::stop, .arm = arm, .detail = stop->cause};
  }
  return std::nullopt;
}

WaitingLeg ArmRests::leg_of(const Cell& cell, StepId step, const Trajectory& motion) {
  WaitingLeg leg{.step = step, .arms = motion.arms(), .from = {}, .to = {}};
  Configuration from = rest_, to = rest_;
  set_joints(from, motion, motion.start());
  set_joints(to, motion, motion.goal());
  for (ArmId arm : leg.arms) {
    leg.from.push_back(places_.of(arm, joints_of(from, cell.arm(arm).joints)));
    leg.to.push_back(places_.of(arm, joints_of(to, cell.arm(arm).joints)));
  }
  return leg;
}

bool ArmRests::begins_elsewhere(const Cell& cell, const Trajectory& trajectory,
                                std::optional<ArmId> arm) const {
  return !joints_elsewhere(cell, trajectory, rest_, arm).empty();
}

std::optional<std::string> ArmRests::start_mismatch(const Cell& cell,
                                                    const Trajectory& trajectory) const {
  const auto elsewhere = joints_elsewhere(cell, trajectory, rest_);
  if (elsewhere.empty()) return std::nullopt;
  const auto& [place, id, begins, stands] = elsewhere.front();
  const Joint& joint = cell.joint(id);
  char text[256];
  std::snprintf(text, sizeof text, "%s is at %.6g, but the trajectory begins at %.6g",
                joint.name.c_str(), without_rounding_noise(stands), without_rounding_noise(begins));
  const bool turns_round = joint.kind != JointKind::prismatic;
  return text + (turns_round ? whole_turns_apart(stands, begins, cell.execution.start_tolerance_rad)
                             : std::string());
}

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

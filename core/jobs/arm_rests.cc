#include "core/jobs/arm_rests.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "core/base/rounding_noise.h"
#include "core/base/whole_turns.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Of one arm's joints, in its order.
Eigen::VectorXd part_of(const Arm& arm, const Configuration& q) {
  Eigen::VectorXd part(static_cast<Eigen::Index>(arm.joints.size()));
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    part[static_cast<Eigen::Index>(j)] = q[static_cast<Eigen::Index>(arm.joints[j].index())];
  }
  return part;
}

// The same of a position of the trajectory's joints, which names all of the arm's.
Eigen::VectorXd part_of(const Arm& arm, const Trajectory& trajectory,
                        const Eigen::VectorXd& position) {
  Eigen::VectorXd part(static_cast<Eigen::Index>(arm.joints.size()));
  const auto& joints = trajectory.joints();
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    part[static_cast<Eigen::Index>(j)] =
        position[std::ranges::find(joints, arm.joints[j]) - joints.begin()];
  }
  return part;
}

}  // namespace

ArmRests::ArmRests(const Cell& cell, Configuration rest)
    : rest_(std::move(rest)),
      stopped_(cell.arms.size()),
      may_meet_(cell.arms.size()),
      came_by_(cell.arms.size()),
      places_at_(cell.arms.size()) {
  if (rest_.size() != static_cast<Eigen::Index>(cell.joints.size())) {
    throw std::invalid_argument(
        "Scheduler: the size of rest differs from the number of joints of the cell");
  }
  for (std::uint32_t arm = 0; arm < places_at_.size(); ++arm) {
    places_at_[arm] = places_.of(ArmId{arm}, part_of(cell.arm(ArmId{arm}), rest_));
  }
}

void ArmRests::come_to_rest(const Cell& cell, const TrajectoryPtr& motion,
                            const Eigen::VectorXd& position) {
  set_joints(rest_, *motion, position);
  const bool alone = motion->arms().size() == 1;
  for (ArmId arm : motion->arms()) {
    places_at_[arm.index()] = places_.of(arm, part_of(cell.arm(arm), rest_));
    came_by_[arm.index()] = alone ? motion : nullptr;
  }
}

void ArmRests::locate(const Cell& cell, ArmId arm, const Eigen::VectorXd& position) {
  set_joints(rest_, joints_and_gripper(cell.arm(arm)), position);
  places_at_[arm.index()] = places_.of(arm, part_of(cell.arm(arm), rest_));
  came_by_[arm.index()] = nullptr;
}

std::optional<ArmId> ArmRests::unlocated_beside(ArmId arm) const {
  for (std::uint32_t other = 0; other < may_meet_.size(); ++other) {
    if (std::ranges::count(may_meet_[other], arm) > 0) return ArmId{other};
  }
  return std::nullopt;
}

void ArmRests::rest_at_goal(const WaitingLeg& leg) {
  for (std::size_t i = 0; i < leg.arms.size(); ++i) places_at_[leg.arms[i].index()] = leg.to[i];
}

void ArmRests::stop(ArmId arm, std::string cause, bool until_connected) {
  std::optional<StopOfArm>& stop = stopped_[arm.index()];
  if (!stop || stop->until_connected) stop = {std::move(cause), until_connected};
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
  for (ArmId arm : leg.arms) {
    const Arm& moved = cell.arm(arm);
    leg.from.push_back(places_.of(arm, part_of(moved, motion, motion.start())));
    leg.to.push_back(places_.of(arm, part_of(moved, motion, motion.goal())));
  }
  return leg;
}

std::optional<JointId> ArmRests::begins_elsewhere(const Cell& cell, const Trajectory& trajectory,
                                                  std::optional<ArmId> arm) const {
  for (std::size_t j = 0; j < trajectory.joints().size(); ++j) {
    const JointId joint = trajectory.joints()[j];
    if (arm && cell.joint(joint).arm != *arm) continue;
    const double begins = trajectory.start()[static_cast<Eigen::Index>(j)];
    const double stands = rest_[static_cast<Eigen::Index>(joint.index())];
    if (std::abs(begins - stands) > cell.execution.start_tolerance_rad) return joint;
  }
  return std::nullopt;
}

std::optional<std::string> ArmRests::start_mismatch(const Cell& cell,
                                                    const Trajectory& trajectory) const {
  const auto joint = begins_elsewhere(cell, trajectory);
  if (!joint) return std::nullopt;
  const auto j = std::ranges::find(trajectory.joints(), *joint) - trajectory.joints().begin();
  const double stands = rest_[static_cast<Eigen::Index>(joint->index())];
  const double begins = trajectory.start()[j];
  char text[256];
  std::snprintf(text, sizeof text, "%s is at %.6g, but the trajectory begins at %.6g",
                cell.joint(*joint).name.c_str(), without_rounding_noise(stands),
                without_rounding_noise(begins));
  const bool turns_round = cell.joint(*joint).kind != JointKind::prismatic;
  return text + (turns_round ? whole_turns_apart(stands, begins, cell.execution.start_tolerance_rad)
                             : std::string());
}

bool begins_at(const Cell& cell, const Trajectory& motion, const Place& place) {
  const Eigen::VectorXd off = part_of(cell.arm(place.arm), motion, motion.start()) - place.q;
  return off.cwiseAbs().maxCoeff() <= cell.execution.start_tolerance_rad;
}

}  // namespace armloom

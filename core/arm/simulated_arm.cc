#include "core/arm/simulated_arm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

using Phase = ArmFeedback::Phase;

// The arm has arrived if each joint is closer than this to its commanded position.
constexpr double kArrived_rad = 1e-5;

}  // namespace

SimulatedArm::SimulatedArm(CellPtr cell, ArmId arm, Eigen::VectorXd q_start, std::uint64_t seed)
    : cell_(std::move(cell)),
      joints_(cell_->arm(arm).joints),
      controller_(cell_->robots[cell_->arm(arm).robot.index()].controller),
      gaussian_(seed),
      motion_(cell_),
      position_(std::move(q_start)) {
  const Arm& description = cell_->arm(arm);
  joints_.insert(joints_.end(), description.gripper_joints.begin(),
                 description.gripper_joints.end());
  if (position_.size() != static_cast<Eigen::Index>(joints_.size())) {
    throw std::logic_error("SimulatedArm: q_start has " + std::to_string(position_.size()) +
                           " entries for " + std::to_string(joints_.size()) + " joints");
  }
  path_.rows.assign(joints_.size(), -1);
  offset_.left = Eigen::VectorXd::Zero(position_.size());
  feedback_.measured = position_;
}

bool SimulatedArm::under_way() const {
  return feedback_.phase == Phase::waiting || feedback_.phase == Phase::moving ||
         feedback_.phase == Phase::braking;
}

void SimulatedArm::start(TrajectoryPtr trajectory, TimePoint start_at, Duration from_progress,
                         Duration authority) {
  if (under_way()) throw std::logic_error("SimulatedArm::start: a motion is under way");
  if (!trajectory) throw std::logic_error("SimulatedArm::start: no trajectory");
  if (from_progress < Duration{} || from_progress > trajectory->duration()) {
    throw std::logic_error("SimulatedArm::start: progress outside the trajectory");
  }
  std::vector<Eigen::Index> rows(joints_.size(), -1);
  bool concerned = false;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const std::vector<JointId>& all = trajectory->joints();
    const auto found = std::find(all.begin(), all.end(), joints_[j]);
    if (found == all.end()) continue;
    rows[j] = found - all.begin();
    concerned = true;
  }
  if (!concerned)
    throw std::logic_error("SimulatedArm::start: the trajectory moves no joint of the arm");

  trajectory->sample_positions(from_progress, path_.at);
  path_.target = path_.at;  // allocates both before the first tick
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(position_.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (rows[j] >= 0) offset[i] = position_[i] - path_.at[rows[j]];
  }
  const double away = offset.cwiseAbs().maxCoeff();
  if (!(away <= cell_->execution.start_tolerance_rad)) {
    throw std::logic_error("SimulatedArm::start: the arm is " + std::to_string(away) +
                           " rad away from the trajectory");
  }
  path_.trajectory = std::move(trajectory);
  path_.rows = std::move(rows);
  offset_.left = std::move(offset);
  offset_.is_any = away > 0.0;
  motion_.follow(path_.trajectory, from_progress, authority);
  start_at_ = start_at;
  feedback_.phase = Phase::waiting;
  feedback_.rests_at.reset();
  feedback_.commanded_progress = from_progress;
  feedback_.measured_progress = from_progress;
}

void SimulatedArm::grant(Duration authority) {
  if (!path_.trajectory) throw std::logic_error("SimulatedArm::grant: no motion");
  if (under_way()) motion_.grant(authority);
}

void SimulatedArm::brake() {
  if (feedback_.phase == Phase::waiting) {
    feedback_.phase = Phase::stopped;
  } else if (feedback_.phase == Phase::moving &&
             feedback_.commanded_progress < path_.trajectory->duration()) {
    feedback_.phase = Phase::braking;
    feedback_.rests_at = motion_.stop_from_here();
  }
}

void SimulatedArm::release() {
  if (under_way()) throw std::logic_error("SimulatedArm::release: a motion is under way");
  path_.trajectory.reset();
  feedback_.phase = Phase::idle;
  feedback_.commanded_progress = Duration{};
  feedback_.measured_progress = Duration{};
}

const ArmFeedback& SimulatedArm::tick(TimePoint now) {
  if (now < last_tick_) throw std::logic_error("SimulatedArm::tick: time runs backwards");
  const TimePoint previous = std::exchange(last_tick_, now);
  if (feedback_.phase == Phase::waiting) {
    if (now >= start_at_) begin(now, previous);
  } else if (under_way()) {
    advance(now - previous);
  }
  if (controller_.noise_rad > 0.0) measure();
  feedback_.at_rest = stands();
  feedback_.settled = feedback_.at_rest && feedback_.phase != Phase::waiting;
  return feedback_;
}

bool SimulatedArm::stands() const {
  if (!under_way() || feedback_.phase == Phase::waiting) return true;
  return feedback_.phase == Phase::moving && motion_.rate() == 0.0 && !offset_.is_any &&
         motion_.progress() >= motion_.end() &&
         feedback_.measured_progress == feedback_.commanded_progress;
}

void SimulatedArm::begin(TimePoint now, TimePoint previous) {
  feedback_.phase = Phase::moving;
  const bool missed = start_at_ < previous;
  advance(missed ? Duration{} : now - start_at_);
}

void SimulatedArm::advance(Duration period) {
  const Duration before = feedback_.commanded_progress;
  motion_.advance(period, feedback_.phase == Phase::braking);
  feedback_.commanded_progress = motion_.progress();
  const bool moved = feedback_.measured_progress != feedback_.commanded_progress || offset_.is_any;
  if (moved) {
    lag_behind(before, period);
    place();
  }
  if (motion_.rate() == 0.0) settle();
  if (moved && controller_.noise_rad <= 0.0) feedback_.measured = position_;
}

// Moves the measured progress m: solves m' = (s - m) / lag exactly for constant s'.
void SimulatedArm::lag_behind(Duration commanded_before, Duration period) {
  const Duration commanded = feedback_.commanded_progress;
  Duration& measured = feedback_.measured_progress;
  if (controller_.lag <= Duration{}) {
    measured = commanded;
    offset_.is_any = false;
    offset_.left.setZero();
    return;
  }
  if (period <= Duration{}) return;
  const double share = std::exp(-to_seconds(period) / to_seconds(controller_.lag));
  const double steady = to_seconds(controller_.lag) * to_seconds(commanded - commanded_before) /
                        to_seconds(period);  // steady lag at this speed
  const double behind = to_seconds(commanded_before - measured);
  // Rounded down, so that the lag reaches zero.
  const Duration behind_after{
      static_cast<Duration::rep>((steady + (behind - steady) * share) * 1e9)};
  measured = std::clamp(commanded - behind_after, measured, commanded);
  if (offset_.is_any) {
    offset_.left *= share;
    if (offset_.left.cwiseAbs().maxCoeff() < 0.1 * kArrived_rad) {
      offset_.left.setZero();
      offset_.is_any = false;
    }
  }
}

void SimulatedArm::settle() {
  const Duration rest = feedback_.commanded_progress;
  if (feedback_.measured_progress != rest) {
    path_.trajectory->sample_positions(rest, path_.target);
    double left = 0.0;
    for (const Eigen::Index row : path_.rows) {
      if (row >= 0) left = std::max(left, std::abs(path_.target[row] - path_.at[row]));
    }
    if (left >= kArrived_rad) return;
    feedback_.measured_progress = rest;
    place();
  }
  if (offset_.is_any) return;
  if (rest == path_.trajectory->duration()) {
    feedback_.phase = Phase::finished;
  } else if (feedback_.phase == Phase::braking) {
    feedback_.phase = Phase::stopped;
  }
}

void SimulatedArm::place() {
  path_.trajectory->sample_positions(feedback_.measured_progress, path_.at);
  for (std::size_t j = 0; j < path_.rows.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (path_.rows[j] >= 0) position_[i] = path_.at[path_.rows[j]] + offset_.left[i];
  }
}

void SimulatedArm::measure() {
  for (Eigen::Index i = 0; i < position_.size(); ++i) {
    feedback_.measured[i] = position_[i] + controller_.noise_rad * gaussian_.next();
  }
}

}  // namespace armloom

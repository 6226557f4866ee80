#include "core/arm/simulated_arm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

using Phase = ArmFeedback::Phase;

// Closer than this to where it was commanded to rest, the arm is there.
constexpr double kArrived_rad = 1e-5;

}  // namespace

SimulatedArm::SimulatedArm(CellPtr cell, ArmId arm, Eigen::VectorXd q_start, std::uint64_t seed)
    : cell_(std::move(cell)),
      joints_(cell_->arm(arm).joints),
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
  const ControllerDescription& controller = cell_->robots[description.robot.index()].controller;
  lag_ = controller.lag;
  noise_ = controller.noise_rad;
  start_tolerance_ = cell_->execution.start_tolerance_rad;
  rows_.assign(joints_.size(), -1);
  offset_ = Eigen::VectorXd::Zero(position_.size());
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
  if (!concerned) throw std::logic_error("SimulatedArm::start: none of its joints");

  trajectory->sample_positions(from_progress, path_);
  path_target_ = path_;  // both have their size before the first tick
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(position_.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (rows[j] >= 0) offset[i] = position_[i] - path_[rows[j]];
  }
  const double away = offset.cwiseAbs().maxCoeff();
  if (!(away <= start_tolerance_)) {
    throw std::logic_error("SimulatedArm::start: the arm is " + std::to_string(away) +
                           " rad away from the trajectory");
  }
  trajectory_ = std::move(trajectory);
  rows_ = std::move(rows);
  offset_ = std::move(offset);
  has_offset_ = away > 0.0;
  motion_.follow(trajectory_, from_progress, authority);
  start_at_ = start_at;
  feedback_.phase = Phase::waiting;
  feedback_.commanded_progress = from_progress;
  feedback_.measured_progress = from_progress;
}

void SimulatedArm::grant(Duration authority) {
  if (!trajectory_) throw std::logic_error("SimulatedArm::grant: no motion");
  if (under_way()) motion_.grant(authority);
}

void SimulatedArm::brake() {
  if (feedback_.phase == Phase::waiting) {
    feedback_.phase = Phase::stopped;
  } else if (feedback_.phase == Phase::moving &&
             feedback_.commanded_progress < trajectory_->duration()) {
    feedback_.phase = Phase::braking;
  }
}

void SimulatedArm::release() {
  if (under_way()) throw std::logic_error("SimulatedArm::release: a motion is under way");
  trajectory_.reset();
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
  if (noise_ > 0.0) measure();
  feedback_.at_rest = stands();
  feedback_.settled = feedback_.at_rest && feedback_.phase != Phase::waiting;
  return feedback_;
}

bool SimulatedArm::stands() const {
  if (!under_way() || feedback_.phase == Phase::waiting) return true;
  return feedback_.phase == Phase::moving && motion_.rate() == 0.0 && !has_offset_ &&
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
  const bool moved = feedback_.measured_progress != feedback_.commanded_progress || has_offset_;
  if (moved) {
    lag_behind(before, period);
    place();
  }
  if (motion_.rate() == 0.0) settle();
  if (moved && noise_ <= 0.0) feedback_.measured = position_;
}

// m' = (s - m) / lag, solved exactly for s moving evenly through the tick.
void SimulatedArm::lag_behind(Duration commanded_before, Duration period) {
  const Duration commanded = feedback_.commanded_progress;
  Duration& measured = feedback_.measured_progress;
  if (lag_ <= Duration{}) {
    measured = commanded;
    has_offset_ = false;
    offset_.setZero();
    return;
  }
  if (period <= Duration{}) return;
  const double share = std::exp(-to_seconds(period) / to_seconds(lag_));
  const double steady = to_seconds(lag_) * to_seconds(commanded - commanded_before) /
                        to_seconds(period);  // how far behind it would stay at this speed
  const double behind = to_seconds(commanded_before - measured);
  // Rounded down, so that it closes to nothing however slow the lag.
  const Duration behind_after{
      static_cast<Duration::rep>((steady + (behind - steady) * share) * 1e9)};
  measured = std::clamp(commanded - behind_after, measured, commanded);
  if (has_offset_) {
    offset_ *= share;
    if (offset_.cwiseAbs().maxCoeff() < 0.1 * kArrived_rad) {
      offset_.setZero();
      has_offset_ = false;
    }
  }
}

void SimulatedArm::settle() {
  const Duration rest = feedback_.commanded_progress;
  if (feedback_.measured_progress != rest) {
    trajectory_->sample_positions(rest, path_target_);
    double left = 0.0;
    for (const Eigen::Index row : rows_) {
      if (row >= 0) left = std::max(left, std::abs(path_target_[row] - path_[row]));
    }
    if (left >= kArrived_rad) return;
    feedback_.measured_progress = rest;
    place();
  }
  if (has_offset_) return;
  if (rest == trajectory_->duration()) {
    feedback_.phase = Phase::finished;
  } else if (feedback_.phase == Phase::braking) {
    feedback_.phase = Phase::stopped;
  }
}

void SimulatedArm::place() {
  trajectory_->sample_positions(feedback_.measured_progress, path_);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (rows_[j] >= 0) position_[i] = path_[rows_[j]] + offset_[i];
  }
}

void SimulatedArm::measure() {
  for (Eigen::Index i = 0; i < position_.size(); ++i) {
    feedback_.measured[i] = position_[i] + noise_ * gaussian_.next();
  }
}

}  // namespace armloom

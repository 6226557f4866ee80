#include "core/arm/simulated_arm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using Phase = ArmFeedback::Phase;

// The arm has arrived if each joint is closer than this to its commanded position.
constexpr double kArrived_rad = 1e-5;

}  // namespace

SimulatedArm::SimulatedArm(CellPtr cell, ArmId arm, Eigen::VectorXd q_start, std::uint64_t seed)
    : cell_(std::move(cell)),
      joints_(joints_and_gripper(cell_->arm(arm))),
      controller_(cell_->robots[cell_->arm(arm).robot.index()].controller),
      gaussian_(seed),
      motion_(cell_),
      position_(std::move(q_start)) {
  if (position_.size() != static_cast<Eigen::Index>(joints_.size())) {
    throw std::logic_error("SimulatedArm: q_start has " + std::to_string(position_.size()) +
                           " entries for " + std::to_string(joints_.size()) + " joints");
  }
  path_.rows.assign(joints_.size(), -1);
  offset_.left = pushed_ = Eigen::VectorXd::Zero(position_.size());
  feedback_.measured = position_;
}

bool SimulatedArm::under_way() const {
  return feedback_.phase == Phase::waiting || feedback_.phase == Phase::moving ||
         feedback_.phase == Phase::braking;
}

// ---- Commands ----

void SimulatedArm::send(const ArmCommand& command) {
  if (command.number != feedback_.acknowledged + 1) return;
  feedback_.acknowledged = command.number;
  std::string why = std::visit([this](const auto& what) { return carry_out(what); }, command.what);
  if (why.empty()) return;
  feedback_.rejected = command.number;
  feedback_.detail = std::move(why);
  if (std::holds_alternative<ArmCommand::Follow>(command.what) && !under_way()) {
    feedback_.phase = Phase::fault;
  }
}

// Returns why the arm cannot follow the trajectory, and otherwise sets path_ and offset_.
std::string SimulatedArm::mapped(const ArmCommand::Follow& follow) {
  if (!follow.trajectory) return "there is no trajectory";
  if (follow.from < Duration{} || follow.from > follow.trajectory->duration()) {
    return "progress " + std::to_string(to_seconds(follow.from)) + " s is outside the trajectory";
  }
  std::vector<Eigen::Index> rows(joints_.size(), -1);
  const std::vector<JointId>& all = follow.trajectory->joints();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto found = std::find(all.begin(), all.end(), joints_[j]);
    if (found != all.end()) rows[j] = found - all.begin();
  }
  if (std::ranges::all_of(rows, [](Eigen::Index row) { return row < 0; })) {
    return "the trajectory moves no joint of the arm";
  }
  Eigen::VectorXd at;
  follow.trajectory->sample_positions(follow.from, at);
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(position_.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (rows[j] >= 0) offset[i] = position_[i] - at[rows[j]];
  }
  Eigen::Index farthest = 0;
  const double away = offset.cwiseAbs().maxCoeff(&farthest);
  if (!(away <= cell_->execution.start_tolerance_rad)) {
    const Joint& joint = cell_->joint(joints_[static_cast<std::size_t>(farthest)]);
    return joint.name + " is " + std::to_string(away) + ' ' + joint.unit() + " from the trajectory";
  }
  path_ = {follow.trajectory, std::move(rows), at, at};
  offset_ = {std::move(offset), away > 0.0};
  pushed_.setZero();
  return {};
}

std::string SimulatedArm::carry_out(const ArmCommand::Follow& follow) {
  if (under_way() || coasting_) return "the arm is in motion";
  if (std::string why = mapped(follow); !why.empty()) return why;
  motion_.follow(path_.trajectory, follow.from, follow.authority);
  start_at_ = follow.start_at;
  switches_off_ = false;
  feedback_.phase = Phase::waiting;
  feedback_.rests_at.reset();
  feedback_.detail.clear();
  feedback_.drives_on = true;
  feedback_.commanded_progress = follow.from;
  feedback_.measured_progress = follow.from;
  feedback_.authority = motion_.authority();
  return {};
}

std::string SimulatedArm::carry_out(const ArmCommand::Extend& extend) {
  if (!path_.trajectory) return "there is no motion";
  if (!under_way()) return {};
  motion_.grant(extend.authority);
  feedback_.authority = motion_.authority();
  return {};
}

std::string SimulatedArm::carry_out(const ArmCommand::Brake& brake) {
  if (brake.category == StopCategory::switch_off) {
    feedback_.drives_on = false;
    if (feedback_.phase == Phase::moving || feedback_.phase == Phase::braking) {
      JointState state;
      path_.trajectory->sample(feedback_.measured_progress, state);
      coasting_ = Eigen::VectorXd::Zero(position_.size());
      for (std::size_t j = 0; j < path_.rows.size(); ++j) {
        if (path_.rows[j] < 0) continue;
        (*coasting_)[static_cast<Eigen::Index>(j)] = motion_.rate() * state.velocity[path_.rows[j]];
      }
      feedback_.phase = Phase::braking;
      feedback_.rests_at.reset();
      return {};
    }
  }
  switches_off_ = brake.category != StopCategory::brake;
  if (feedback_.phase == Phase::waiting) {
    feedback_.phase = Phase::stopped;
  } else if (feedback_.phase == Phase::moving &&
             feedback_.commanded_progress < path_.trajectory->duration()) {
    feedback_.phase = Phase::braking;
    feedback_.rests_at = motion_.stop_from_here();
  }
  if (switches_off_ && !under_way()) feedback_.drives_on = false;
  return {};
}

std::string SimulatedArm::carry_out(const ArmCommand::Release&) {
  if (under_way() || coasting_) return "the arm is in motion";
  path_.trajectory.reset();
  feedback_.phase = Phase::idle;
  feedback_.commanded_progress = Duration{};
  feedback_.measured_progress = Duration{};
  feedback_.authority = Duration{};
  return {};
}

std::string SimulatedArm::carry_out(const ArmCommand::SetSpeed& speed) {
  if (!(speed.share >= 0.0 && speed.share <= 1.0)) return "the speed override is not within 0..1";
  if (!(speed.brake > 0.0 && speed.brake <= 1.0))
    return "the share of the brake is not within 0..1";
  brake_ = speed.brake;
  motion_.set_speed(std::min(1.0, speed.share / clock()));
  return {};
}

// ---- Each control cycle ----

const ArmFeedback* SimulatedArm::poll(TimePoint now) {
  if (polled_at_ == now) return nullptr;
  polled_at_ = now;
  tick(now);
  if (now < reports_at_) return nullptr;
  reports_at_ = std::max(reports_at_ + controller_.feedback_period, now + kControlPeriod);
  ++feedback_.sequence;
  feedback_.controller_time = now.time_since_epoch();
  return &feedback_;
}

const ArmFeedback& SimulatedArm::tick(TimePoint now) {
  if (now < last_tick_) throw std::logic_error("SimulatedArm::tick: time runs backwards");
  const TimePoint previous = std::exchange(last_tick_, now);
  if (coasting_) {
    coast(now - previous);
  } else if (feedback_.phase == Phase::waiting) {
    if (now >= start_at_) begin(now, previous);
  } else if (under_way()) {
    advance(now - previous);
  }
  if (controller_.noise_rad > 0.0) measure();
  feedback_.at_rest = stands();
  feedback_.settled = feedback_.at_rest && feedback_.phase != Phase::waiting;
  return feedback_;
}

void SimulatedArm::place_at(const Eigen::VectorXd& q) {
  if (under_way() || coasting_) return;
  position_ = q;
  measure();
}

// Each joint brakes by itself, until all rest off the path.
void SimulatedArm::coast(Duration period) {
  const double period_s = to_seconds(period);
  double fastest = 0.0;
  for (Eigen::Index i = 0; i < position_.size(); ++i) {
    double& velocity = (*coasting_)[i];
    const double slower =
        brake_ * cell_->joint(joints_[static_cast<std::size_t>(i)]).brake * period_s;
    const double after = std::copysign(std::max(0.0, std::abs(velocity) - slower), velocity);
    position_[i] += 0.5 * (velocity + after) * period_s;
    velocity = after;
    fastest = std::max(fastest, std::abs(after));
  }
  if (controller_.noise_rad <= 0.0) feedback_.measured = position_;
  if (fastest > 0.0) return;
  coasting_.reset();
  feedback_.phase = Phase::fault;
  feedback_.detail = "the drives were switched off in motion, so the arm is off its path";
}

bool SimulatedArm::stands() const {
  if (coasting_) return false;
  if (!under_way() || feedback_.phase == Phase::waiting) return true;
  return feedback_.phase == Phase::moving && motion_.rate() == 0.0 && !offset_.is_any &&
         (motion_.progress() >= motion_.end() || motion_.speed() == 0.0) &&
         feedback_.measured_progress == feedback_.commanded_progress;
}

void SimulatedArm::begin(TimePoint now, TimePoint previous) {
  feedback_.phase = Phase::moving;
  const bool missed = start_at_ < previous;
  advance(missed ? Duration{} : now - start_at_);
}

void SimulatedArm::advance(Duration period) {
  const Duration before = feedback_.commanded_progress;
  motion_.advance(brake_ == 1.0 ? period : from_seconds(to_seconds(period) * clock()),
                  feedback_.phase == Phase::braking);
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
  if (switches_off_ && !under_way()) feedback_.drives_on = false;
}

void SimulatedArm::place() {
  path_.trajectory->sample_positions(feedback_.measured_progress, path_.at);
  for (std::size_t j = 0; j < path_.rows.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (path_.rows[j] >= 0) position_[i] = path_.at[path_.rows[j]] + offset_.left[i] + pushed_[i];
  }
}

void SimulatedArm::push(Eigen::Index joint, double distance) {
  pushed_[joint] += distance;
  position_[joint] += distance;
  if (controller_.noise_rad <= 0.0) feedback_.measured = position_;
}

void SimulatedArm::measure() {
  for (Eigen::Index i = 0; i < position_.size(); ++i) {
    feedback_.measured[i] = position_[i] + controller_.noise_rad * gaussian_.next();
  }
}

}  // namespace armloom

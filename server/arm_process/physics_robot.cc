#include "server/arm_process/physics_robot.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using Phase = ArmFeedback::Phase;

// The plant rests if each joint is slower than this (rad/s or m/s).
constexpr double kRestSpeed = 0.01;
// A servo that does not reach its goal within the tracking error counts as arrived after this time:
// the deviation is for the monitor.
constexpr std::chrono::milliseconds kSettles{500};
// Step of the search for the measured progress.
constexpr std::chrono::microseconds kSearchStep{100};

std::vector<JointId> joints_of_arm(const armloom::Arm& arm) {
  std::vector<JointId> joints = arm.joints;
  joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
  return joints;
}

}  // namespace

// The controller of one arm.
class PhysicsRobot::Arm final : public ArmController {
 public:
  Arm(std::shared_ptr<PhysicsRobot> robot, Simulated& arm) : robot_(std::move(robot)), arm_(arm) {}

  [[nodiscard]] const std::vector<JointId>& joints() const override {
    return arm_.reference.joints();
  }
  void send(const ArmCommand& command) override { robot_->send(arm_, command); }
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override {
    robot_->advance(now);
    if (now < reports_at_) return nullptr;
    reports_at_ =
        std::max(reports_at_ + robot_->robot_.controller.feedback_period, now + kControlPeriod);
    ++arm_.feedback.sequence;
    arm_.feedback.controller_time = now.time_since_epoch();
    return &arm_.feedback;
  }

 private:
  std::shared_ptr<PhysicsRobot> robot_;
  Simulated& arm_;
  TimePoint reports_at_{};
};

PhysicsRobot::Simulated::Simulated(const CellPtr& cell, ArmId arm)
    : id(arm), reference(cell, arm, joints_of(cell->home(), joints_of_arm(cell->arm(arm))), 1) {}

Result<std::shared_ptr<PhysicsRobot>> PhysicsRobot::create(CellPtr cell, RobotId robot,
                                                           std::optional<Payload> payload,
                                                           Log log) {
  Problems warnings;
  auto plant = Plant::create(cell, {.robot = robot, .payload = std::move(payload)}, warnings);
  if (!plant) return failure(std::move(plant.error()));
  for (const Problem& warning : warnings) {
    log({LogLine::Level::warning, warning.pointer + ": " + warning.detail});
  }
  return std::shared_ptr<PhysicsRobot>(
      new PhysicsRobot(std::move(cell), robot, std::move(*plant), std::move(log)));
}

PhysicsRobot::PhysicsRobot(CellPtr cell, RobotId robot, Plant plant, Log log)
    : cell_(std::move(cell)),
      robot_(cell_->robots[robot.index()]),
      plant_(std::move(plant)),
      log_(std::move(log)),
      position_(plant_.state().position),
      velocity_(Eigen::VectorXd::Zero(position_.size())) {
  // The reference has no noise of its own.
  auto exact = std::make_shared<Cell>(*cell_);
  exact->robots[robot.index()].controller.noise_rad = 0.0;
  arms_.reserve(robot_.arms.size());
  for (const ArmId id : robot_.arms) {
    Simulated& arm = arms_.emplace_back(exact, id);
    for (const JointId joint : arm.reference.joints()) {
      arm.rows.push_back(std::ranges::find(plant_.joints(), joint) - plant_.joints().begin());
    }
    arm.feedback.measured = *arm.reference.true_positions();
  }
}

std::vector<std::unique_ptr<ArmController>> PhysicsRobot::controllers(
    const std::shared_ptr<PhysicsRobot>& robot) {
  std::vector<std::unique_ptr<ArmController>> all;
  for (Simulated& arm : robot->arms_) all.push_back(std::make_unique<Arm>(robot, arm));
  return all;
}

void PhysicsRobot::send(Simulated& arm, const ArmCommand& command) {
  if (!arm.has_drives) move_with_plant(arm);
  if (std::holds_alternative<ArmCommand::Follow>(command.what)) arm.follow = command;
  arm.reference.send(command);
}

// Without drives, the arm is where the plant has come to rest.
void PhysicsRobot::move_with_plant(Simulated& arm) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(arm.rows.size()));
  for (std::size_t j = 0; j < arm.rows.size(); ++j) {
    q[static_cast<Eigen::Index>(j)] = plant_.state().position[arm.rows[j]];
  }
  arm.reference.place_at(q);
}

void PhysicsRobot::advance(TimePoint now) {
  if (now_ == now) return;
  const Duration period = now_ ? now - *now_ : kControlPeriod;
  now_ = now;
  for (Simulated& arm : arms_) {
    const ArmFeedback& reference = arm.reference.tick(now);
    if (reference.drives_on != arm.has_drives) {
      arm.has_drives = reference.drives_on;
      plant_.switch_drives(arm.id, arm.has_drives);
    }
    for (std::size_t j = 0; j < arm.rows.size(); ++j) {
      const double commanded = (*arm.reference.true_positions())[static_cast<Eigen::Index>(j)];
      velocity_[arm.rows[j]] = (commanded - position_[arm.rows[j]]) / to_seconds(period);
      position_[arm.rows[j]] = commanded;
    }
  }
  plant_.step(period, position_, velocity_);
  for (Simulated& arm : arms_) report(arm, arm.reference.state(), period);
  tell_contacts();
}

bool PhysicsRobot::rests(const Simulated& arm) const {
  const double tolerance =
      robot_.controller.tracking_error_rad.value_or(cell_->checking.tracking_error_rad);
  return std::ranges::all_of(arm.rows, [&](Eigen::Index row) {
    const bool is_there = !arm.has_drives || arm.unsettled > kSettles ||
                          std::abs(plant_.state().position[row] - position_[row]) <= tolerance;
    return is_there && std::abs(plant_.state().velocity[row]) < kRestSpeed;
  });
}

void PhysicsRobot::report(Simulated& arm, const ArmFeedback& reference, Duration period) {
  if (arm.follow && reference.acknowledged >= arm.follow->number) {
    if (reference.rejected != arm.follow->number) {
      const auto& follow = std::get<ArmCommand::Follow>(arm.follow->what);
      arm.trajectory = follow.trajectory;
      arm.feedback.measured_progress = follow.from;
    }
    arm.follow.reset();
  }
  const Duration before = arm.feedback.measured_progress;
  const std::uint64_t sequence = arm.feedback.sequence;
  const Duration reported_at = arm.feedback.controller_time;
  arm.feedback = reference;
  arm.feedback.sequence = sequence;
  arm.feedback.controller_time = reported_at;
  for (std::size_t j = 0; j < arm.rows.size(); ++j) {
    arm.feedback.measured[static_cast<Eigen::Index>(j)] = plant_.state().position[arm.rows[j]];
  }
  arm.unsettled = reference.at_rest ? arm.unsettled + period : Duration{};
  const Phase phase = reference.phase;
  if (phase == Phase::idle || phase == Phase::waiting) return;
  if (reference.at_rest && rests(arm)) return;
  arm.feedback.at_rest = arm.feedback.settled = false;
  // The plant still moves.
  if (phase == Phase::finished) arm.feedback.phase = Phase::moving;
  if (phase == Phase::stopped || phase == Phase::fault) arm.feedback.phase = Phase::braking;

  Duration& measured = arm.feedback.measured_progress;
  const Duration farthest = reference.measured_progress;
  double closest = std::numeric_limits<double>::infinity();
  Eigen::VectorXd path;
  const std::vector<JointId>& joints = arm.trajectory->joints();
  for (Duration s = std::min(before, farthest);; s = std::min(s + kSearchStep, farthest)) {
    arm.trajectory->sample_positions(s, path);
    double away = 0.0;
    for (std::size_t j = 0; j < arm.rows.size(); ++j) {
      const auto row = std::ranges::find(joints, arm.reference.joints()[j]) - joints.begin();
      if (row == static_cast<std::ptrdiff_t>(joints.size())) continue;
      const double off = arm.feedback.measured[static_cast<Eigen::Index>(j)] - path[row];
      away += off * off;
    }
    if (away < closest) {
      closest = away;
      measured = s;
    }
    if (s == farthest) break;
  }
}

void PhysicsRobot::tell_contacts() {
  for (const BodyContact& contact : plant_.state().contacts) {
    std::string pair = contact.body_a + " and " + contact.body_b;
    if (std::ranges::find(told_, pair) != told_.end()) continue;
    log_({LogLine::Level::error, "CONTACT of " + pair, {{"depth_m", contact.depth_m}}});
    told_.push_back(std::move(pair));
  }
}

}  // namespace armloom

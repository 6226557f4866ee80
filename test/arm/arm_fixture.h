#pragma once

#include <cstdint>
#include <random>

#include "core/arm/simulated_arm.h"

namespace armloom {

// A handmade cell: two seven-joint arms with a Panda's limits, the left with a gripper joint.
// JointIds: 0..6 left, 7 left gripper, 8..14 right.
struct CellOptions {
  Duration lag = std::chrono::milliseconds(20);
  double noise_rad = 0.0;
  double brake_per_acceleration = 2.0;
};
[[nodiscard]] CellPtr two_arm_cell(CellOptions options = {});
inline const ArmId kLeft{0};
inline const ArmId kRight{1};

// Polynomials through random waypoints, at rest at both ends. Their duration is the shortest that
// keeps the velocity and acceleration limits.
enum class Pieces {
  quintic,  // acceleration is continuous
  cubic,    // acceleration jumps at the waypoints
};
[[nodiscard]] TrajectoryPtr random_trajectory(const Cell& cell, std::vector<JointId> joints,
                                              std::vector<ArmId> arms, std::mt19937_64& random,
                                              Pieces pieces = Pieces::quintic);
[[nodiscard]] std::vector<JointId> joints_of(const Cell& cell, ArmId arm);  // without the gripper

// Returns the controller's joint positions at the start of `trajectory`; other joints are at zero.
[[nodiscard]] Eigen::VectorXd at_start(const Trajectory& trajectory, const Cell& cell, ArmId arm);

// Sends commands to a controller and numbers them.
struct Commander {
  explicit Commander(ArmController& the_controller) : controller(the_controller) {}

  void start(TrajectoryPtr trajectory, TimePoint start_at, Duration from, Duration authority) {
    controller.send(
        {++number, ArmCommand::Follow{std::move(trajectory), start_at, from, authority}});
  }
  void grant(Duration authority) { controller.send({++number, ArmCommand::Extend{authority}}); }
  void brake(StopCategory category = StopCategory::brake) {
    controller.send({++number, ArmCommand::Brake{category}});
  }
  void set_speed(double share, double brake = 1.0) {
    controller.send({++number, ArmCommand::SetSpeed{share, brake}});
  }
  void release() { controller.send({++number, ArmCommand::Release{}}); }

  ArmController& controller;
  CommandNumber number = 0;
};

struct Bench {
  Bench(CellPtr the_cell, ArmId the_arm, const Trajectory& first, std::uint64_t seed = 1)
      : cell(std::move(the_cell)), arm(cell, the_arm, at_start(first, *cell, the_arm), seed) {}

  const ArmFeedback& tick() {
    now += kControlPeriod;
    return arm.tick(now);
  }
  const ArmFeedback& tick_for(Duration time) {
    for (const TimePoint end = now + time - kControlPeriod; now < end;) tick();
    return tick();
  }
  // Ticks until the arm is in this phase. Fails the test if that takes more than `most` of
  // simulated time.
  const ArmFeedback& tick_until(ArmFeedback::Phase phase,
                                Duration most = std::chrono::seconds(120));

  CellPtr cell;
  SimulatedArm arm;
  Commander command{arm};
  TimePoint now{};
};

// Records the largest joint acceleration as a share of the limit at that time. Accelerations are
// second differences of the commanded positions.
class AccelerationGauge {
 public:
  AccelerationGauge(const Cell& cell, TrajectoryPtr trajectory);
  // `brake`: the share of the limits that the arm keeps.
  void observe(const ArmFeedback& feedback, bool may_brake, double brake = 1.0);
  void restart() { known_ = 0; }  // the next positions do not continue the last ones
  [[nodiscard]] double worst_share() const { return worst_share_; }

 private:
  TrajectoryPtr trajectory_;
  Eigen::VectorXd acceleration_;
  Eigen::VectorXd brake_;
  Eigen::VectorXd before_;
  Eigen::VectorXd last_;
  Eigen::VectorXd now_;
  int known_ = 0;
  bool braked_before_ = false;
  double worst_share_ = 0.0;
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/arm/commanded_progress.h"
#include "core/arm/gaussian_noise.h"
#include "core/model/cell.h"

namespace armloom {

// A simulated arm with a 1 kHz control cycle. Commanded progress advances along the path at a rate
// (0..1) that a brake lowers to zero, and a start or resume raises to one, as fast as the joints'
// brake (acceleration) limits allow: |q'(s) s'' + q''(s) s'^2| <= limit for every joint. Measured
// progress follows the commanded one with a first-order lag (ControllerDescription::lag); measured
// positions are the path at the measured progress plus, if asked for, Gaussian noise from the seed.
// Deterministic: the same seed and the same calls give the same feedback, bit for bit.
//
// What the interface leaves open:
// - From the very start of a path (at rest there) the rate is one at once; elsewhere it begins at
// zero.
// - Whoever shares a trajectory brakes alike: the limits of all its joints bind the rate, so the
//   commanded progress of synchronous arms stays equal.
// - At rest at its authority the phase stays `moving`; more authority continues the motion.
// - A grant that comes too late to stop for is raised to where a brake brings the arm to rest.
// - A brake on the last stretch may come to rest at the goal: the phase is then `finished`.
// - A start that is off the path (within execution.start_tolerance_rad) is pulled in with the lag.
// - It never reports `fault`.
// Broken preconditions throw std::logic_error.
class SimulatedArm final : public ArmController {
 public:
  // `q_start`: positions of arm.joints followed by arm.gripper_joints.
  SimulatedArm(CellPtr cell, ArmId arm, Eigen::VectorXd q_start, std::uint64_t seed);

  [[nodiscard]] const std::vector<JointId>& joints() const override { return joints_; }
  void start(TrajectoryPtr trajectory, TimePoint start_at, Duration from_progress,
             Duration authority) override;
  void grant(Duration authority) override;
  void brake() override;
  void release() override;
  const ArmFeedback& tick(TimePoint now) override;

 private:
  void begin(TimePoint now, TimePoint previous);
  void advance(Duration period);
  void lag_behind(Duration commanded_before, Duration period);
  void settle();
  void place();    // position_ from the measured progress
  void measure();  // feedback_.measured from position_
  [[nodiscard]] bool under_way() const;
  [[nodiscard]] bool stands() const;

  CellPtr cell_;
  std::vector<JointId> joints_;
  const ControllerDescription& controller_;
  GaussianNoise gaussian_;
  CommandedProgress motion_;
  TimePoint start_at_{};
  TimePoint last_tick_{};

  struct Path {
    TrajectoryPtr trajectory;
    std::vector<Eigen::Index> rows;  // of the trajectory, for each of joints_; -1: not in it
    Eigen::VectorXd at;              // scratch, of the trajectory's joints: at measured progress
    Eigen::VectorXd target;          // the same, at commanded progress
  };
  Path path_;
  Eigen::VectorXd position_;  // of joints_: where the arm truly is
  struct Offset {
    Eigen::VectorXd left;  // of joints_: of the distance to the path at the start
    bool is_any = false;
  };
  Offset offset_;
  ArmFeedback feedback_;
};

}  // namespace armloom

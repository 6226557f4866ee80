#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/model/cell.h"

namespace armloom {

// A simulated arm with a 1 kHz control cycle. Commanded progress advances along the path at a rate
// (0..1) that a brake lowers to zero, and a start or resume raises to one, as fast as the joints'
// brake (acceleration) limits allow: |q'(s) s'' + q''(s) s'^2| <= limit for every joint. Measured
// progress follows the commanded one with a first-order lag (ControllerDescription::lag); measured
// positions are the path at the measured progress plus, if asked for, Gaussian noise from the seed.
// Deterministic: the same seed and the same calls give the same feedback, bit for bit.
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

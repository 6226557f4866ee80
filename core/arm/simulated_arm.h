#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/arm/commanded_progress.h"
#include "core/arm/gaussian_noise.h"
#include "core/model/cell.h"

namespace armloom {

// A simulated arm with a 1 kHz control cycle. A brake lowers the rate (0..1) of commanded progress
// to zero, and a start or resume raises it to the speed override, as fast as the joints' brake or
// acceleration limits permit: |q'(s) s'' + q''(s) s'^2| <= limit. Measured progress follows with a
// first-order lag (ControllerDescription::lag). Measured positions are the positions on the path at
// measured progress, plus optional Gaussian noise. Deterministic: the same seed and calls give the
// same feedback, bit for bit.
//
// Behavior that the interface leaves open:
// - A motion that begins at the start of its path, where the path itself is at rest, has rate one
//   (or the speed override) at once. Elsewhere the rate begins at zero.
// - Synchronous arms keep equal commanded progress, because all joints of the trajectory limit the
//   rate.
// - When the arm rests at its authority, the phase stays `moving`. More authority continues the
//   motion.
// - An authority that is too close for a brake is raised to where the brake ends.
// - A brake near the goal may end at the goal. The phase is then `finished`.
// - An arm that starts off the path (within execution.start_tolerance_rad) approaches the path with
//   the lag.
// - Commands take effect when they are sent. It reports every
//   ControllerDescription::feedback_period.
// - Drives that are switched off in motion (StopCategory::switch_off) let each joint brake by
//   itself, off the path. At rest, the phase is then `fault`, as is that of a rejected motion.
class SimulatedArm final : public ArmController {
 public:
  // `q_start`: positions of arm.joints followed by arm.gripper_joints.
  SimulatedArm(CellPtr cell, ArmId arm, Eigen::VectorXd q_start, std::uint64_t seed);

  [[nodiscard]] const std::vector<JointId>& joints() const override { return joints_; }
  void send(const ArmCommand& command) override;
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override;
  [[nodiscard]] const Eigen::VectorXd* true_positions() const override { return &position_; }
  // Moves a joint by `distance` (rad, m) off its path. It stays off until the next motion.
  void push(Eigen::Index joint, double distance);
  // Runs one control cycle up to `now` and returns the arm's state. Called by poll().
  const ArmFeedback& tick(TimePoint now);
  // Returns the state after the last tick.
  [[nodiscard]] const ArmFeedback& state() const { return feedback_; }
  // Places an arm at rest, without drives, at `q` (as joints()): it was moved from outside. No
  // effect while the arm moves.
  void place_at(const Eigen::VectorXd& q);

 private:
  // Each returns why the command is rejected; empty if it is carried out.
  std::string carry_out(const ArmCommand::Follow& follow);
  std::string carry_out(const ArmCommand::Extend& extend);
  std::string carry_out(const ArmCommand::Brake& brake);
  std::string carry_out(const ArmCommand::Release& release);
  std::string carry_out(const ArmCommand::SetSpeed& speed);
  void begin(TimePoint now, TimePoint previous);
  void advance(Duration period);
  void lag_behind(Duration commanded_before, Duration period);
  void settle();
  void coast(Duration period);
  void place();    // position_ from the measured progress
  void measure();  // feedback_.measured from position_
  [[nodiscard]] bool under_way() const;
  [[nodiscard]] bool stands() const;
  // Returns the share of time at which the motion goes: with the share b of all accelerations, an
  // arm does the same as with empty hands, but everything takes 1/sqrt(b) times as long.
  [[nodiscard]] double clock() const { return std::sqrt(brake_); }
  [[nodiscard]] std::string mapped(const ArmCommand::Follow& follow);

  CellPtr cell_;
  std::vector<JointId> joints_;
  const ControllerDescription& controller_;
  GaussianNoise gaussian_;
  CommandedProgress motion_;
  double brake_ = 1.0;  // SetSpeed::brake
  TimePoint start_at_{};
  TimePoint last_tick_{};
  std::optional<TimePoint> polled_at_;
  TimePoint reports_at_{};  // time of the next report

  struct Path {
    TrajectoryPtr trajectory;
    std::vector<Eigen::Index> rows;  // rows of joints_ in the trajectory; -1 if absent
    Eigen::VectorXd at;              // scratch: the trajectory's joints at measured progress
    Eigen::VectorXd target;          // scratch: the same at commanded progress
  };
  Path path_;
  Eigen::VectorXd position_;  // true positions of joints_
  Eigen::VectorXd pushed_;    // distance from the path, by push() since the start of the motion
  struct Offset {
    Eigen::VectorXd left;  // what remains of the distance of joints_ from the path at the start
    bool is_any = false;
  };
  Offset offset_;
  std::optional<Eigen::VectorXd> coasting_;  // velocities of joints_ while the drives are off
  bool switches_off_ = false;                // at the end of this brake
  ArmFeedback feedback_;
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <random>

#include "core/arm/simulated_arm.h"

namespace armloom {

// A cell of two arms, built by hand: seven joints each with a Panda's limits, the first one with a
// gripper joint besides. JointIds: 0..6 left, 7 left gripper, 8..14 right.
struct CellOptions {
  Duration lag = std::chrono::milliseconds(20);
  double noise_rad = 0.0;
  double brake_per_acceleration = 2.0;
};
[[nodiscard]] CellPtr two_arm_cell(CellOptions options = {});
inline const ArmId kLeft{0};
inline const ArmId kRight{1};

// Piecewise polynomials through random waypoints, at rest at both ends, scaled in time so that the
// hardest of velocity and acceleration limits is just met.
enum class Pieces {
  quintic,  // acceleration is continuous
  cubic,    // acceleration jumps at the waypoints
};
[[nodiscard]] TrajectoryPtr random_trajectory(const Cell& cell, std::vector<JointId> joints,
                                              std::vector<ArmId> arms, std::mt19937_64& random,
                                              Pieces pieces = Pieces::quintic);
[[nodiscard]] std::vector<JointId> joints_of(const Cell& cell, ArmId arm);  // without the gripper

// Positions of a controller's joints where `trajectory` starts; joints that are not in it at zero.
[[nodiscard]] Eigen::VectorXd at_start(const Trajectory& trajectory, const Cell& cell, ArmId arm);

// An arm with its hand-driven clock.
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
  // Until the phase is reached; fails the test after `most` of simulated time.
  const ArmFeedback& tick_until(ArmFeedback::Phase phase,
                                Duration most = std::chrono::seconds(120));

  CellPtr cell;
  SimulatedArm arm;
  TimePoint now{};
};

// The joints' accelerations by second differences of the commanded positions, tick by tick: keeps
// the largest as a share of what was allowed then.
class AccelerationGauge {
 public:
  AccelerationGauge(const Cell& cell, TrajectoryPtr trajectory);
  void observe(const ArmFeedback& feedback, bool may_brake);
  void restart() { known_ = 0; }  // what comes does not continue what was
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

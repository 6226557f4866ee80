#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/validate.h"

namespace armloom::experiments {

// Uniform in [from, to): the standard's distributions differ between libraries.
[[nodiscard]] double uniform(std::mt19937_64& random, double from, double to);

// One straight line in joint space, from rest to rest, and a time to stand at its end.
struct Leg {
  Eigen::VectorXd q;   // rad, as Arm::joints
  double speed = 1.0;  // (0, 1]: share of the fastest that kLimitShare allows
  double stand_s = 0.0;
};

// Of each joint's velocity and acceleration limit, what a line at speed 1 uses at its peaks.
inline constexpr double kLimitShare = 0.8;

// Lines from `start` through every leg, each the quintic that begins and ends with no velocity and
// no acceleration (config/joint_moves.py), sent as ten pieces. A line takes a multiple of 10 ms,
// 0.2 s at least.
[[nodiscard]] TrajectoryRequest way(const Cell& cell, ArmId arm, const Eigen::VectorXd& start,
                                    const std::vector<Leg>& legs);
[[nodiscard]] double line_time_s(const Cell& cell, ArmId arm, const Eigen::VectorXd& from,
                                 const Eigen::VectorXd& to);

// Rounded up to a multiple of 10 ms.
[[nodiscard]] double whole_10_ms(double time_s);

// Joint positions near `guess` with the arm's link `tool` (with prefix) at p_WT, its z axis down;
// the turn about that axis stays near the guess's. Damped least squares on numeric derivatives;
// to 0.1 mm and 1 mrad, 0.05 rad within the joints' limits. nullopt: none found.
[[nodiscard]] std::optional<Eigen::VectorXd> tool_down(const Cell& cell, ArmId arm,
                                                       const std::string& tool,
                                                       const Eigen::Vector3d& p_WT,
                                                       const Eigen::VectorXd& guess);

}  // namespace armloom::experiments

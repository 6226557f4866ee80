#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/validate.h"

namespace armloom::experiments {

// Uniform in [from, to), equal for all standard libraries.
[[nodiscard]] double uniform(std::mt19937_64& random, double from, double to);

// A line in joint space, from rest to rest, and a rest at its end.
struct Leg {
  Eigen::VectorXd q;   // rad, as Arm::joints
  double speed = 1.0;  // (0, 1], share of the fastest speed within kLimitShare
  double stand_s = 0.0;
};

// At speed 1 the peak velocity and acceleration of a line use this share of each joint's limits at
// most.
inline constexpr double kLimitShare = 0.8;

// Returns lines from `start` through every leg: quintics at rest at both ends
// (config/joint_moves.py), in ten pieces. A line takes a multiple of 10 ms, at least 0.2 s.
[[nodiscard]] TrajectoryRequest way(const Cell& cell, ArmId arm, const Eigen::VectorXd& start,
                                    const std::vector<Leg>& legs);
[[nodiscard]] double line_time_s(const Cell& cell, ArmId arm, const Eigen::VectorXd& from,
                                 const Eigen::VectorXd& to);

// Rounds up to a multiple of 10 ms.
[[nodiscard]] double whole_10_ms(double time_s);

// Returns joint positions near `guess` with the link `tool` (with prefix) at p_WT and its z axis
// down. Damped least squares, to 0.1 mm and 1 mrad, 0.05 rad inside the joint limits. nullopt if
// none was found.
[[nodiscard]] std::optional<Eigen::VectorXd> tool_down(const Cell& cell, ArmId arm,
                                                       const std::string& tool,
                                                       const Eigen::Vector3d& p_WT,
                                                       const Eigen::VectorXd& guess);

}  // namespace armloom::experiments

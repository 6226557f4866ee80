#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/ids.h"
#include "core/model/cell.h"

namespace armloom {

// Maximum rates, a row for each joint: rad/s, rad/s^2, rad/s^3 (m for prismatic joints); > 0.
struct JointRates {
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;
  Eigen::VectorXd jerk;
};

// Shares of the cell's limits (core/model/README.md), each in (0, 1], like MoveIt's scaling
// factors. Jerk is not scaled: lower accelerations already make motions softer.
struct RateShares {
  double velocity = 1.0;
  double acceleration = 1.0;
};

// Throws std::invalid_argument if a share is not in (0, 1].
[[nodiscard]] JointRates rates_of(const Cell& cell, const std::vector<JointId>& joints,
                                  const RateShares& shares = {});

}  // namespace armloom

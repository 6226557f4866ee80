#include "core/trajectory/timing/joint_rates.h"

#include <stdexcept>

namespace armloom {

JointRates rates_of(const Cell& cell, const std::vector<JointId>& joints,
                    const RateShares& shares) {
  for (const double share : {shares.velocity, shares.acceleration}) {
    if (!(share > 0.0 && share <= 1.0))
      throw std::invalid_argument("rates_of: a share is not in (0, 1]");
  }
  const auto size = static_cast<Eigen::Index>(joints.size());
  JointRates rates{Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size)};
  for (Eigen::Index j = 0; j < size; ++j) {
    const Joint& joint = cell.joint(joints[static_cast<std::size_t>(j)]);
    rates.velocity[j] = shares.velocity * joint.velocity_max;
    rates.acceleration[j] = shares.acceleration * joint.acceleration_max;
    rates.jerk[j] = joint.jerk_max;
  }
  return rates;
}

}  // namespace armloom

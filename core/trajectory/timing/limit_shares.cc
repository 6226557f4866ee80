#include <algorithm>
#include <cmath>

#include "core/trajectory/polynomial.h"
#include "core/trajectory/timing/time_parameterization.h"

namespace armloom {
namespace {

// Returns the largest |value| at both ends of [0, h] and at those `places` that are inside.
template <class Value>
double largest(const Value& value, double h, std::initializer_list<double> places) {
  double most = std::max(std::abs(value(0.0)), std::abs(value(h)));
  for (const double t : places) {
    if (t > 0.0 && t < h) most = std::max(most, std::abs(value(t)));
  }
  return most;
}

// Raises the shares to those that joint j uses on a piece of h seconds. Exact extremes of jerk
// (quadratic) and acceleration (cubic) are computed only if they may exceed the shares so far.
void add(const Polynomial& c, double h, const JointRates& rates, Eigen::Index j,
         LimitShares& shares) {
  const double j0 = 6.0 * c[3], j1 = 24.0 * c[4], j2 = 60.0 * c[5];
  double most_jerk = std::abs(j0) + h * (std::abs(j1) + h * std::abs(j2));
  if (most_jerk > shares.jerk * rates.jerk[j]) {
    const auto jerk = [&](double t) { return j0 + t * (j1 + t * j2); };
    most_jerk = largest(jerk, h, {-j1 / (2.0 * j2)});
    shares.jerk = std::max(shares.jerk, most_jerk / rates.jerk[j]);
  }
  // The acceleration is bounded by its value at the nearer end plus the change that the jerk
  // permits. The velocity is bounded in the same way.
  const auto acceleration = [&](double t) {
    return 2.0 * c[2] + t * (j0 + t * (j1 / 2.0 + t * j2 / 3.0));
  };
  double most_acceleration = largest(acceleration, h, {}) + 0.5 * h * most_jerk;
  if (most_acceleration > shares.acceleration * rates.acceleration[j]) {
    // Zeros of the jerk, in the numerically stable form.
    const double root = std::sqrt(std::max(0.0, j1 * j1 - 4.0 * j2 * j0));
    const double sum = -0.5 * (j1 + std::copysign(root, j1));
    most_acceleration = largest(acceleration, h, {sum / j2, j0 / sum});
    shares.acceleration = std::max(shares.acceleration, most_acceleration / rates.acceleration[j]);
  }
  const Polynomial v = derivative(c);
  const double ends = std::max(std::abs(v[0]), std::abs(evaluate(v, h)));
  if (ends + 0.5 * h * most_acceleration <= shares.velocity * rates.velocity[j]) return;
  const Bounds enclosed = bounds(v, 0.0, h);
  double most = std::max(-enclosed.lower, enclosed.upper);
  if (most > rates.velocity[j]) {  // according to the bounds
    const auto out = worst_outside(v, h, {-rates.velocity[j], rates.velocity[j]});
    most = out ? std::abs(out->value) : rates.velocity[j];
  }
  shares.velocity = std::max(shares.velocity, most / rates.velocity[j]);
}

}  // namespace

LimitShares limit_shares(const std::vector<WaypointRequest>& points, const JointRates& rates) {
  LimitShares shares;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const WaypointRequest& from = points[k];
    const WaypointRequest& to = points[k + 1];
    const double h =
        to_seconds(from_seconds(to.time_from_start_s) - from_seconds(from.time_from_start_s));
    for (std::size_t j = 0; j < from.positions.size(); ++j) {
      add(quintic({from.positions[j], from.velocities[j], from.accelerations[j]},
                  {to.positions[j], to.velocities[j], to.accelerations[j]}, h),
          h, rates, static_cast<Eigen::Index>(j), shares);
    }
  }
  return shares;
}

}  // namespace armloom

#include "test/trajectory/timing/phase_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace armloom::testing {
namespace {

struct Slope {
  Eigen::VectorXd first, second;
};

// Returns the largest (sign 1) or smallest (sign -1) acceleration of s at speed sqrt(x).
double acceleration(const Slope& q, const JointRates& rates, double x, double sign) {
  double most = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < q.first.size(); ++j) {
    if (std::abs(q.first[j]) < 1e-9) continue;
    const double of_s = std::copysign(1.0, q.first[j]) * sign;
    most = std::min(most, (rates.acceleration[j] - of_s * q.second[j] * x) / std::abs(q.first[j]));
  }
  return sign * most;
}

// Returns the largest x (squared speed) within the velocity limits at which some acceleration is
// possible.
double fastest(const Slope& q, const JointRates& rates) {
  double x = 1e6;
  for (Eigen::Index j = 0; j < q.first.size(); ++j) {
    const double by_velocity = rates.velocity[j] / std::max(1e-9, std::abs(q.first[j]));
    x = std::min(x, by_velocity * by_velocity);
  }
  double low = 0.0;
  if (acceleration(q, rates, x, 1.0) >= acceleration(q, rates, x, -1.0)) return x;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + x);
    const bool open = acceleration(q, rates, middle, 1.0) >= acceleration(q, rates, middle, -1.0);
    (open ? low : x) = middle;
  }
  return low;
}

}  // namespace

double least_time_s(const JointPath& path, const JointRates& rates, std::size_t steps) {
  const double ds = path.length() / static_cast<double>(steps);
  std::vector<Slope> slopes;
  std::vector<double> x;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double h = 1e-4 * path.length() / 100.0;
    const double s = std::clamp(ds * static_cast<double>(i), h, path.length() - h);
    const Eigen::VectorXd before = path.position(s - h);
    const Eigen::VectorXd here = path.position(s);
    const Eigen::VectorXd after = path.position(s + h);
    slopes.push_back({(after - before) / (2.0 * h), (after - 2.0 * here + before) / (h * h)});
    x.push_back(fastest(slopes.back(), rates));
  }
  x.front() = x.back() = 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    x[i + 1] = std::min(x[i + 1], x[i] + 2.0 * ds * acceleration(slopes[i], rates, x[i], 1.0));
  }
  for (std::size_t i = steps; i > 0; --i) {
    x[i - 1] = std::min(x[i - 1], x[i] - 2.0 * ds * acceleration(slopes[i], rates, x[i], -1.0));
  }
  double time_s = 0.0;
  for (std::size_t i = 0; i < steps; ++i) {
    time_s += 2.0 * ds / (std::sqrt(std::max(0.0, x[i])) + std::sqrt(std::max(0.0, x[i + 1])));
  }
  return time_s;
}

}  // namespace armloom::testing

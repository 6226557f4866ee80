#include "core/trajectory/timing/soft_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace armloom {
namespace {

constexpr double kKnotsApart_s = 5e-4;

// Gauss-Legendre places and weights on [-1, 1], exact for polynomials up to degree five.
constexpr std::array<double, 3> kPlaces{-0.7745966692414834, 0.0, 0.7745966692414834};
constexpr std::array<double, 3> kWeights{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

// Evaluates q and q' at ascending times.
class Reader {
 public:
  Reader(const JointPath& path, const std::vector<Station>& stations)
      : path_(path), stations_(stations), q(path.joints()), v(path.joints()) {}

  void read(double t) {
    while (at_ + 2 < stations_.size() && stations_[at_ + 1].time_s <= t) ++at_;
    const Station& from = stations_[at_];
    const Station& to = stations_[at_ + 1];
    const double dt = std::clamp(t - from.time_s, 0.0, to.time_s - from.time_s);
    const bool moves = t > 0.0 && t < stations_.back().time_s;
    const double speed = moves ? from.speed + from.acceleration * dt : 0.0;
    const double s = from.s + dt * (from.speed + 0.5 * dt * from.acceleration);
    const double x = std::min(s, to.s) - path_.begin(from.piece);
    const double* c = path_.coefficients(from.piece).data();
    for (std::size_t j = 0; j < q.size(); ++j, c += 4) {
      q[j] = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
      v[j] = speed * (c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]));
    }
  }

 private:
  const JointPath& path_;
  const std::vector<Station>& stations_;
  std::size_t at_ = 0;

 public:
  std::vector<double> q, v;
};

// Returns the largest jump of a joint's acceleration at a station, as a share of its limit.
double jump_at(const JointPath& path, const JointRates& rates, const Station& before,
               const Station& at) {
  const double* c = path.coefficients(at.piece).data();
  const double x = at.s - path.begin(at.piece);
  const double* b = path.coefficients(before.piece).data();
  const double y = at.s - path.begin(before.piece);
  double most = 0.0;
  for (std::size_t j = 0; j < path.joints(); ++j, b += 4, c += 4) {
    const double slope = c[1] + x * (2.0 * c[2] + x * 3.0 * c[3]);
    const double bend = 2.0 * (c[2] - b[2]) + 6.0 * (x * c[3] - y * b[3]);
    const double jump =
        slope * (at.acceleration - before.acceleration) + bend * at.speed * at.speed;
    most = std::max(most, std::abs(jump) / rates.acceleration[static_cast<Eigen::Index>(j)]);
  }
  return most;
}

// Returns the times of waypoints, from -T/2 on.
std::vector<double> knots_of(const JointPath& path, const JointRates& rates,
                             const std::vector<Station>& stations, double half_s) {
  std::vector<double> times;
  times.reserve(2 * stations.size());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const bool inner = i > 0 && i + 1 < stations.size();
    if (inner && jump_at(path, rates, stations[i - 1], stations[i]) < kSmallJump) {
      times.push_back(stations[i].time_s);
      continue;
    }
    times.push_back(stations[i].time_s - half_s);
    times.push_back(stations[i].time_s + half_s);
  }
  std::ranges::sort(times);
  std::vector<double> knots{times.front()};
  for (const double t : times) {
    if (t - knots.back() >= kKnotsApart_s && times.back() - t >= kKnotsApart_s) knots.push_back(t);
  }
  knots.push_back(times.back());
  // Waypoints have whole nanoseconds.
  for (double& t : knots) t = std::round((t + half_s) * 1e9) / 1e9 - half_s;
  return knots;
}

}  // namespace

std::vector<WaypointRequest> softened(const JointPath& path, const JointRates& rates,
                                      const std::vector<Station>& stations, double window_s) {
  const double half_s = 0.5 * window_s;
  const std::vector<double> knots = knots_of(path, rates, stations, half_s);
  const std::size_t joints = path.joints();
  Reader before(path, stations), after(path, stations);
  const std::vector<double> still(joints, 0.0);

  before.read(0.0);
  std::vector<WaypointRequest> points{{before.q, still, still, 0.0}};
  points.reserve(knots.size());
  for (std::size_t k = 1; k < knots.size(); ++k) {
    WaypointRequest point{points.back().positions, still, still, knots[k] + half_s};
    const double half_step = 0.5 * (knots[k] - knots[k - 1]);
    const double middle = knots[k] - half_step;
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {  // integrates the mean's velocity
      const double t = middle + kPlaces[i] * half_step;
      before.read(t - half_s);
      after.read(t + half_s);
      const double weight = kWeights[i] * half_step / window_s;
      for (std::size_t j = 0; j < joints; ++j) {
        point.positions[j] += weight * (after.q[j] - before.q[j]);
      }
    }
    if (k + 1 < knots.size()) {
      before.read(knots[k] - half_s);
      after.read(knots[k] + half_s);
      for (std::size_t j = 0; j < joints; ++j) {
        point.velocities[j] = (after.q[j] - before.q[j]) / window_s;
        point.accelerations[j] = (after.v[j] - before.v[j]) / window_s;
      }
    }
    points.push_back(std::move(point));
  }
  points.back().positions.assign(path.goal().begin(), path.goal().end());
  return points;
}

}  // namespace armloom

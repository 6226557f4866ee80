#include "core/trajectory/timing/time_parameterization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/trajectory/joint_line.h"
#include "core/trajectory/timing/path_speed.h"
#include "core/trajectory/timing/rest_to_rest.h"
#include "core/trajectory/timing/soft_motion.h"

namespace armloom {
namespace {

using Points = std::vector<Eigen::VectorXd>;

// Minimum number of parts of a path.
constexpr std::size_t kParts = 160;
// Quintics usually exceed the motion by less than this share; rare cases are slowed down.
constexpr double kHeadroom = 1.0 - 2e-3;

TrajectoryRequest request_for(const Cell& cell, const std::vector<JointId>& joints) {
  TrajectoryRequest request;
  for (const JointId joint : joints) request.joint_names.push_back(cell.joint(joint).name);
  return request;
}

void require_size(const std::vector<JointId>& joints, std::size_t size) {
  if (size != joints.size()) {
    throw std::invalid_argument("time parameterisation: one position for each joint");
  }
}

WaypointRequest on_line(const Eigen::VectorXd& from, const Eigen::VectorXd& way,
                        const ProfileKnot& knot, double begin_s) {
  WaypointRequest point;
  for (Eigen::Index j = 0; j < way.size(); ++j) {
    point.positions.push_back(from[j] + knot.s * way[j]);
    point.velocities.push_back(knot.velocity * way[j]);
    point.accelerations.push_back(knot.acceleration * way[j]);
  }
  point.time_from_start_s = begin_s + to_seconds(knot.time);
  return point;
}

// Appends the fastest straight motion, with its first point only if there is none yet.
void append_line(TrajectoryRequest& request, const JointRates& rates, const Eigen::VectorXd& from,
                 const Eigen::VectorXd& to) {
  const Eigen::VectorXd way = to - from;
  ProfileRates of_s{std::numeric_limits<double>::infinity(), of_s.velocity, of_s.velocity};
  for (Eigen::Index j = 0; j < way.size(); ++j) {
    const double d = std::abs(way[j]);
    if (d == 0.0) continue;
    of_s.velocity = std::min(of_s.velocity, rates.velocity[j] / d);
    of_s.acceleration = std::min(of_s.acceleration, rates.acceleration[j] / d);
    of_s.jerk = std::min(of_s.jerk, rates.jerk[j] / d);
  }
  const double begin_s = request.points.empty() ? 0.0 : request.points.back().time_from_start_s;
  std::vector<ProfileKnot> knots{{Duration{}, 0.0, 0.0, 0.0}, {kLineMin, 1.0, 0.0, 0.0}};
  if (!std::isinf(of_s.velocity)) knots = rest_to_rest(of_s);
  for (const ProfileKnot& knot : knots) {
    if (knot.time == Duration{} && !request.points.empty()) continue;
    request.points.push_back(on_line(from, way, knot, begin_s));
  }
  request.points.back().positions.assign(to.begin(), to.end());
}

// Slows a motion: velocities are divided by `factor`, accelerations by its square. Waypoints move
// to where the motion is at whole nanoseconds.
void slow_down(std::vector<WaypointRequest>& points, double factor) {
  for (WaypointRequest& point : points) {
    const double exact_s = factor * point.time_from_start_s;
    point.time_from_start_s = std::round(exact_s * 1e9) / 1e9;
    const double later_s = point.time_from_start_s - exact_s;
    for (std::size_t j = 0; j < point.positions.size(); ++j) {
      point.accelerations[j] /= factor * factor;
      point.velocities[j] /= factor;
      point.positions[j] += later_s * point.velocities[j];
      point.velocities[j] += later_s * point.accelerations[j];
    }
  }
}

Result<TimedMotion> validated(TrajectoryRequest request, const Cell& cell) {
  request.is_made_here = true;
  auto trajectory = validate(request, cell);
  if (!trajectory) return failure(std::move(trajectory.error()));
  return TimedMotion{std::move(request), *std::move(trajectory)};
}

}  // namespace

Result<TimedMotion> time_line(const Cell& cell, const std::vector<JointId>& joints,
                              const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                              const TimingOptions& options) {
  return time_lines(cell, joints, {from, to}, options);
}

Result<TimedMotion> time_lines(const Cell& cell, const std::vector<JointId>& joints,
                               const Points& points, const TimingOptions& options) {
  if (points.size() < 2) throw std::invalid_argument("time_lines: two points or more");
  for (const auto& point : points) require_size(joints, static_cast<std::size_t>(point.size()));
  const JointRates rates = rates_of(cell, joints, options.shares);
  TrajectoryRequest request = request_for(cell, joints);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    append_line(request, rates, points[i], points[i + 1]);
  }
  return validated(std::move(request), cell);
}

Result<TimedMotion> time_path(const Cell& cell, const std::vector<JointId>& joints,
                              const JointPath& path, const TimingOptions& options) {
  require_size(joints, path.joints());
  const JointRates limits = rates_of(cell, joints, options.shares);
  JointRates rates = limits;
  double window_s = 2.0 * (rates.acceleration.array() / rates.jerk.array()).maxCoeff();
  const double off = rates.acceleration.maxCoeff() * window_s * window_s / 24.0;
  if (window_s > kWindowMin_s && off > options.off_path) {
    // The window scales with accelerations, the deviation with their third power.
    const double share = std::cbrt(options.off_path / off);
    rates.acceleration *= share;
    window_s *= share;
  }
  window_s = std::max(window_s, kWindowMin_s);
  rates.velocity *= 1.0 - 1e-4;
  rates.acceleration *= kHeadroom;
  TrajectoryRequest request = request_for(cell, joints);
  request.points = softened(path, rates, fastest_along(path, rates, kParts), window_s);
  if (request.points.size() <= kWaypointsMax) {  // else it is refused
    const LimitShares used = limit_shares(request.points, limits);
    const double factor =
        std::max({used.velocity, std::sqrt(used.acceleration), std::cbrt(used.jerk)});
    if (factor > 1.0) slow_down(request.points, factor * (1.0 + 1e-6));
  }
  return validated(std::move(request), cell);
}

}  // namespace armloom

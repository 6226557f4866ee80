#include "core/trajectory/joint_line.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "core/trajectory/validate.h"

namespace armloom {
namespace {

constexpr double kPeakVelocity = 15.0 / 8.0;
constexpr double kPeakAcceleration = 10.0 / std::numbers::sqrt3;
constexpr double kPeakJerk = 60.0;

double least_duration_s(const Joint& joint, double distance) {
  return std::max({kPeakVelocity * distance / joint.velocity_max,
                   std::sqrt(kPeakAcceleration * distance / joint.acceleration_max),
                   std::cbrt(kPeakJerk * distance / joint.jerk_max)});
}

WaypointRequest at_rest(const Eigen::VectorXd& position, double time_s) {
  const std::vector<double> zeros(static_cast<std::size_t>(position.size()), 0.0);
  return {{position.begin(), position.end()}, zeros, zeros, time_s};
}

// Turns p(t) into p(h - t): the Taylor polynomial about h, with the signs of odd powers changed.
void reverse(Eigen::Matrix<double, Eigen::Dynamic, 6>& c, double h) {
  for (Eigen::Index j = 0; j < c.rows(); ++j) {
    for (Eigen::Index k = 0; k < 5; ++k) {
      for (Eigen::Index i = 4; i >= k; --i) c(j, i) += h * c(j, i + 1);
    }
    for (Eigen::Index k = 1; k < 6; k += 2) c(j, k) = -c(j, k);
  }
}

}  // namespace

Result<TrajectoryPtr> joint_line(const Cell& cell, const std::vector<JointId>& joints,
                                 const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                                 std::optional<double> speed) {
  const auto size = static_cast<Eigen::Index>(joints.size());
  if (from.size() != size || to.size() != size) {
    throw std::invalid_argument("joint_line: give one position for each joint");
  }
  TrajectoryRequest request;
  double duration_s = to_seconds(kLineMin);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Joint& joint = cell.joint(joints[static_cast<std::size_t>(j)]);
    request.joint_names.push_back(joint.name);
    duration_s = std::max(duration_s, least_duration_s(joint, std::abs(to[j] - from[j])));
  }
  duration_s /= speed.value_or(cell.execution.velocity_scaling_factor);
  // Round up to whole nanoseconds.
  duration_s = std::min(std::ceil(duration_s * 1e9) / 1e9, 2 * kDurationMax_s);
  request.points = {at_rest(from, 0.0), at_rest(to, duration_s)};
  return validate(request, cell);
}

TrajectoryPtr line_or_stay(const Cell& cell, const std::vector<JointId>& joints,
                           const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                           std::optional<double> speed) {
  auto line = joint_line(cell, joints, from, to, speed);
  if (!line) line = joint_line(cell, joints, to, to, speed);
  return line ? *line : nullptr;
}

TrajectoryPtr retraced(const Trajectory& trajectory) {
  std::vector<Segment> segments = trajectory.segments();
  std::ranges::reverse(segments);
  for (Segment& segment : segments) {
    segment.start = trajectory.duration() - (segment.start + segment.duration);
    reverse(segment.coefficients, to_seconds(segment.duration));
  }
  return std::make_shared<const Trajectory>(trajectory.joints(), trajectory.arms(),
                                            std::move(segments));
}

}  // namespace armloom

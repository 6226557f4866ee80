#include "core/trajectory/check_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "core/trajectory/polynomial.h"
#include "core/trajectory/request_checks.h"

namespace armloom {
namespace {

struct Quantity {
  const char* slug;
  const char* member;  // of a waypoint
  const char* per;     // unit, after rad or m
  std::uint8_t bit;
};
constexpr Quantity kPosition{"position-limit", "positions", "", 1};
constexpr Quantity kVelocity{"velocity-limit", "velocities", "/s", 2};
constexpr Quantity kAcceleration{"acceleration-limit", "accelerations", "/s^2", 4};

std::string unit(const Joint& joint, const Quantity& quantity) {
  return joint.unit() + quantity.per;
}

std::string digits(double value, int count) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", count, value);
  return text;
}

// Returns "3.41 rad/s exceeds 2.175", with enough digits to tell the two apart. `nominal` is the
// cell's limit without tolerances.
std::string excess_text(const Joint& joint, const Quantity& quantity, double value,
                        const Bounds& nominal) {
  const bool is_position = quantity.bit == kPosition.bit;
  const bool below = is_position && value < nominal.lower;
  const double limit = below ? nominal.lower : nominal.upper;
  int count = 6;
  while (count < 17 && digits(std::abs(value), count) == digits(std::abs(limit), count)) ++count;
  return digits(value, count) + " " + unit(joint, quantity) + (below ? " is below " : " exceeds ") +
         digits(limit, count);
}

// Checks each waypoint and the segment that ends there.
class LimitCheck {
 public:
  LimitCheck(const TrajectoryRequest& request, const std::vector<Duration>& times,
             const std::vector<JointId>& joints, const Cell& cell, ProblemList& problems)
      : request_(request),
        times_(times),
        joints_(joints),
        cell_(cell),
        problems_(problems),
        share_(1.0 + cell.checking.limit_tolerance),
        quintic_(!request.points.front().accelerations.empty()),
        broken_before_(joints.size(), 0),
        broken_(joints.size(), 0) {}

  CheckedSegments run() {
    CheckedSegments checked;
    checked.segments.reserve(request_.points.size() - 1);
    for (std::size_t k = 0; k < request_.points.size(); ++k) {
      broken_before_.swap(broken_);
      check_waypoint(k);
      if (k > 0) checked.segments.push_back(checked_segment(k));
    }
    checked.too_fast = too_fast_;
    return checked;
  }

 private:
  [[nodiscard]] const Joint& joint(std::size_t j) const { return cell_.joint(joints_[j]); }

  [[nodiscard]] bool is_end(std::size_t k) const {
    return k == 0 || k + 1 == request_.points.size();
  }

  // Returns joint j's state at waypoint k. Velocities at both ends are set to exactly zero.
  [[nodiscard]] KnotState knot(std::size_t k, std::size_t j) const {
    const WaypointRequest& point = request_.points[k];
    return {point.positions[j], is_end(k) ? 0.0 : point.velocities[j],
            quintic_ ? point.accelerations[j] : 0.0};
  }

  [[nodiscard]] static Bounds nominal(const Joint& joint, const Quantity& quantity) {
    if (quantity.bit == kPosition.bit) return {joint.lower, joint.upper};
    const double limit =
        quantity.bit == kVelocity.bit ? joint.velocity_max : joint.acceleration_max;
    return {-limit, limit};
  }

  [[nodiscard]] Bounds allowed(const Joint& joint, const Quantity& quantity,
                               double position_tolerance) const {
    const Bounds limit = nominal(joint, quantity);
    if (quantity.bit != kPosition.bit) return {limit.lower * share_, limit.upper * share_};
    return {limit.lower - position_tolerance, limit.upper + position_tolerance};
  }

  void check_waypoint(std::size_t k) {
    const WaypointRequest& point = request_.points[k];
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      broken_[j] = 0;
      check_value(k, j, kPosition, point.positions[j]);
      check_value(k, j, kVelocity, point.velocities[j]);
      if (quintic_) check_value(k, j, kAcceleration, point.accelerations[j]);
      if (is_end(k) && std::abs(point.velocities[j]) > kRestVelocity) not_at_rest(k, j);
    }
  }

  // Raises too_fast_ if a velocity or acceleration exceeds its limit by a larger factor.
  // Accelerations fall with the square of the scaling factor.
  void note_excess(const Quantity& quantity, double value, double limit) {
    if (quantity.bit == kPosition.bit) return;
    const double excess = std::abs(value) / limit;
    too_fast_ = std::max(too_fast_, quantity.bit == kVelocity.bit ? excess : std::sqrt(excess));
  }

  void check_value(std::size_t k, std::size_t j, const Quantity& quantity, double value) {
    const Bounds limit = allowed(joint(j), quantity, kPositionTolerance);
    if (value >= limit.lower && value <= limit.upper) return;
    note_excess(quantity, value, limit.upper);
    broken_[j] = static_cast<std::uint8_t>(broken_[j] | quantity.bit);
    if (problems_.full()) return;
    problems_.add({ProblemKind::invalid, quantity.slug,
                   pointer_to(request_, k) + "/" + quantity.member + "/" + std::to_string(j),
                   waypoint(request_, k) + ", " + joint(j).name + ": " +
                       excess_text(joint(j), quantity, value, nominal(joint(j), quantity)),
                   value});
  }

  void not_at_rest(std::size_t k, std::size_t j) {
    const double value = request_.points[k].velocities[j];
    problems_.add({ProblemKind::invalid, "not-at-rest",
                   pointer_to(request_, k) + "/velocities/" + std::to_string(j),
                   waypoint(request_, k) + ", " + joint(j).name + ": " + to_text(value) + " " +
                       unit(joint(j), kVelocity) + " at the " + (k == 0 ? "start" : "end") +
                       ", where the motion must be at rest (" + to_text(kRestVelocity) + ")" +
                       kRetimeRemedy,
                   value});
  }

  Segment checked_segment(std::size_t k) {
    const Duration duration = times_[k] - times_[k - 1];
    const double duration_s = to_seconds(duration);
    Segment segment{times_[k - 1], duration, {}};
    segment.coefficients.resize(static_cast<Eigen::Index>(joints_.size()), kDegree + 1);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Polynomial p = quintic_ ? quintic(knot(k - 1, j), knot(k, j), duration_s)
                                    : cubic(knot(k - 1, j), knot(k, j), duration_s);
      check_between(k, j, p, duration_s);
      for (std::size_t i = 0; i < p.size(); ++i) {
        segment.coefficients(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = p[i];
      }
    }
    return segment;
  }

  // Checks the segment between waypoints k - 1 and k. A quantity that breaks its limit at one of
  // these waypoints is not reported again.
  void check_between(std::size_t k, std::size_t j, const Polynomial& p, double duration_s) {
    const Polynomial v = derivative(p);
    const Polynomial a = derivative(v);
    if (!std::isfinite(magnitude(p, duration_s)) || !std::isfinite(magnitude(v, duration_s)) ||
        !std::isfinite(magnitude(a, duration_s))) {
      problems_.add({ProblemKind::invalid, "not-finite", pointer_to(request_, k),
                     before_waypoint(request_, k) + ", " + joint(j).name +
                         ": too far apart to be interpolated",
                     "overflow"});
      return;
    }
    check_range(k, j, kPosition, p, duration_s);
    check_range(k, j, kVelocity, v, duration_s);
    check_range(k, j, kAcceleration, a, duration_s);
  }

  void check_range(std::size_t k, std::size_t j, const Quantity& quantity, const Polynomial& p,
                   double duration_s) {
    const Bounds limit = allowed(joint(j), quantity, kPositionOvershoot);
    const std::optional<Extreme> worst = worst_outside(p, duration_s, limit);
    if (!worst) return;
    note_excess(quantity, worst->value, limit.upper);
    if (((broken_before_[j] | broken_[j]) & quantity.bit) != 0 || problems_.full()) return;
    problems_.add({ProblemKind::invalid, quantity.slug, pointer_to(request_, k),
                   before_waypoint(request_, k) +
                       " (t = " + to_text(to_seconds(times_[k - 1]) + worst->t_s) + " s), " +
                       joint(j).name + ": " +
                       excess_text(joint(j), quantity, worst->value, nominal(joint(j), quantity)),
                   worst->value});
  }

  const TrajectoryRequest& request_;
  const std::vector<Duration>& times_;
  const std::vector<JointId>& joints_;
  const Cell& cell_;
  ProblemList& problems_;
  const double share_;
  const bool quintic_;
  // By joint: bits of the quantities whose limits are broken at the previous waypoint, and at this
  // waypoint.
  std::vector<std::uint8_t> broken_before_;
  std::vector<std::uint8_t> broken_;
  double too_fast_ = 0.0;
};

}  // namespace

std::string to_text(double value) {
  return std::isnan(value) ? "nan" : digits(value, 6);  // printf has "-nan" too
}

CheckedSegments checked_segments(const TrajectoryRequest& request,
                                 const std::vector<Duration>& times,
                                 const std::vector<JointId>& joints, const Cell& cell,
                                 ProblemList& problems) {
  return LimitCheck(request, times, joints, cell, problems).run();
}

}  // namespace armloom

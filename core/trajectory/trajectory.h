#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// State of the joints at one instant, with a row for each of Trajectory::joints(). rad, rad/s,
// rad/s^2 (m for prismatic joints).
struct JointState {
  Eigen::VectorXd position;
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;
};

// One polynomial piece. coefficients(j, k) of joint j multiplies t^k, with t in seconds since
// `start`.
struct Segment {
  Duration start;
  Duration duration;  // > 0
  Eigen::Matrix<double, Eigen::Dynamic, 6> coefficients;
};

// Bounds on a segment: positions in [lower, upper], |velocity| <= speed, |acceleration| <=
// acceleration. rad, rad/s, rad/s^2 (m).
struct SegmentBounds {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  Eigen::VectorXd speed;
  Eigen::VectorXd acceleration;
};

// Returns bounds of a part of a segment, from `from_s` to `to_s` after the segment's start. A
// shorter part has tighter bounds. Sound up to rounding (1e-12). Precondition: from_s <= to_s.
[[nodiscard]] SegmentBounds bounds_of(const Segment& segment, double from_s, double to_s);

// A valid timed trajectory of the joints of one or more arms: within limits, at rest at both ends.
// Immutable, shared between threads. Made by validate() (core/trajectory/validate.h). Interpolated
// as by ROS's joint_trajectory_controller: cubics if waypoints have positions and velocities,
// quintics if they also have accelerations.
class Trajectory {
 public:
  // `timed_here`: times and velocities were computed, not given by a client. Throws
  // std::invalid_argument unless
  // - segments are contiguous from zero,
  // - each segment has a positive duration, finite coefficients and joints.size() rows,
  // - arms ascend without repetition, and
  // - joints, arms and segments are not empty.
  Trajectory(std::vector<JointId> joints, std::vector<ArmId> arms, std::vector<Segment> segments,
             bool timed_here = false);

  // Returns the joints in the order of the request. All vectors have their rows in the same order.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<ArmId>& arms() const { return arms_; }
  [[nodiscard]] std::size_t segment_count() const { return starts_.size(); }
  // These two functions return copies.
  [[nodiscard]] Segment segment(std::size_t index) const;
  [[nodiscard]] std::vector<Segment> segments() const;
  // Returns the memory used, in bytes.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] Duration duration() const { return duration_; }
  [[nodiscard]] bool timed_here() const { return timed_here_; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  [[nodiscard]] const Eigen::VectorXd& goal() const { return goal_; }

  // Computes the state at `progress` (trajectory time): before zero the start at rest, from the end
  // on the goal at rest. At a waypoint, the segment that begins there is used. Allocates only if
  // the output has another size. Takes one binary search, about 30 ns for 7 joints and 100
  // waypoints.
  void sample(Duration progress, JointState& state) const;
  void sample_positions(Duration progress, Eigen::VectorXd& position) const;

  // Returns bounds for each segment, from its Taylor polynomial at the middle: sound up to rounding
  // (1e-12).
  [[nodiscard]] std::vector<SegmentBounds> bounds() const;
  // Encloses the positions between two instants about a straight line: the position at the middle
  // instant, continued with the velocity there. For t between `from` and `to`,
  //   |q(t) - position - velocity (t - middle)| <= off.
  // Resizes the vectors as needed. Sound up to rounding (1e-12). Precondition: 0 <= from <= to <=
  // duration.
  struct AboutLine {
    Eigen::VectorXd position, velocity, off;
  };
  void enclose_about_line(Duration from, Duration to, AboutLine& line) const;

 private:
  // Views a segment's coefficients.
  using Piece = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6>>;
  [[nodiscard]] Piece piece(std::size_t segment) const;
  [[nodiscard]] Duration end_of(std::size_t segment) const;
  // Precondition: 0 <= progress < duration.
  [[nodiscard]] std::size_t segment_at(Duration progress) const;

  bool timed_here_;
  std::vector<JointId> joints_;
  std::vector<ArmId> arms_;
  // Coefficients of all segments (up to 10,000) in one array. Values that can be computed are not
  // stored.
  std::vector<double> coefficients_;
  std::vector<Duration> starts_;  // start of each segment
  Duration duration_;
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
};

using TrajectoryPtr = std::shared_ptr<const Trajectory>;

}  // namespace armloom

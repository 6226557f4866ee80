#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// State of the joints at one instant; sizes as Trajectory::joints(). rad, rad/s, rad/s^2 (m for
// prismatic joints).
struct JointState {
  Eigen::VectorXd position;
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;
};

// One polynomial piece: coefficients(j, k) multiplies t^k, t seconds since `start`.
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

// Returns bounds of a segment from `from_s` to `to_s` after its start; a shorter part has tighter
// bounds. Sound up to rounding (1e-12). Precondition: from_s <= to_s.
[[nodiscard]] SegmentBounds bounds_of(const Segment& segment, double from_s, double to_s);

// A valid timed trajectory of the joints of one or more arms: within limits, at rest at both ends.
// Immutable, shared between threads. Made by validate() (core/trajectory/validate.h). Interpolated
// as by ROS's joint_trajectory_controller: cubic from positions and velocities, quintic with
// accelerations.
class Trajectory {
 public:
  // Throws std::invalid_argument unless segments are contiguous from zero, each of positive
  // duration, with finite coefficients and joints.size() rows; arms ascend without repetition; and
  // nothing is empty. `timed_here`: times and velocities were computed, not given by a client.
  Trajectory(std::vector<JointId> joints, std::vector<ArmId> arms, std::vector<Segment> segments,
             bool timed_here = false);

  // In the order of the request, as are the rows of all vectors.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<ArmId>& arms() const { return arms_; }
  [[nodiscard]] std::size_t segment_count() const { return starts_.size(); }
  // Return copies.
  [[nodiscard]] Segment segment(std::size_t index) const;
  [[nodiscard]] std::vector<Segment> segments() const;
  // Returns the memory used.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] Duration duration() const { return duration_; }
  [[nodiscard]] bool timed_here() const { return timed_here_; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  [[nodiscard]] const Eigen::VectorXd& goal() const { return goal_; }

  // Returns the start at rest before zero, the goal at rest from the end on; at a waypoint the
  // segment that begins there. `progress` is trajectory time. Allocates only if the argument has
  // another size. One binary search: about 30 ns for 7 joints and 100 waypoints.
  void sample(Duration progress, JointState& state) const;
  void sample_positions(Duration progress, Eigen::VectorXd& position) const;

  // Returns bounds for each segment, from its Taylor polynomial at the middle: sound up to rounding
  // (1e-12).
  [[nodiscard]] std::vector<SegmentBounds> bounds() const;
  // Bounds the distance of positions between two instants from the line through the middle, with
  // the velocity there:
  // |q(t) - position - velocity (t - middle)| <= off, t from `from` to `to`. Resizes as needed;
  // sound up to rounding (1e-12). Precondition: 0 <= from <= to <= duration.
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
  // One array for all segments, up to 10,000; computable values are not stored.
  std::vector<double> coefficients_;
  std::vector<Duration> starts_;  // contiguous for the search
  Duration duration_;
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
};

using TrajectoryPtr = std::shared_ptr<const Trajectory>;

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// State of the joints of one trajectory at one instant; sizes as Trajectory::joints().
// rad, rad/s, rad/s^2 (m for prismatic joints).
struct JointState {
  Eigen::VectorXd position;
  Eigen::VectorXd velocity;
  Eigen::VectorXd acceleration;
};

// One polynomial piece for all joints: coefficients(j, k) multiplies t^k, t seconds since `start`.
struct Segment {
  Duration start;
  Duration duration;  // > 0
  Eigen::Matrix<double, Eigen::Dynamic, 6> coefficients;
};

// What a segment's joints cannot exceed on it: positions lie in [lower, upper], |velocity| <=
// speed, |acceleration| <= acceleration. rad, rad/s, rad/s^2 (m).
struct SegmentBounds {
  Eigen::VectorXd lower;
  Eigen::VectorXd upper;
  Eigen::VectorXd speed;
  Eigen::VectorXd acceleration;
};

// Returns bounds of the part of a segment from `from_s` to `to_s` after its start; a shorter part
// has tighter bounds. Sound up to rounding (1e-12). Precondition: from_s <= to_s.
[[nodiscard]] SegmentBounds bounds_of(const Segment& segment, double from_s, double to_s);

// A valid timed trajectory of the joints of one or more arms: parsed, within limits, at rest at
// both ends. Immutable; made only by validate() (core/trajectory/validate.h) and shared freely,
// between threads too. Interpolation is that of ROS's joint_trajectory_controller: cubic where
// positions and velocities are given, quintic where accelerations are too.
class Trajectory {
 public:
  // Precondition (throws std::invalid_argument): at least one segment, contiguous from zero, each
  // longer than nothing, every coefficient matrix finite with joints.size() rows, joints not empty,
  // arms ascending without repetition and not empty.
  Trajectory(std::vector<JointId> joints, std::vector<ArmId> arms, std::vector<Segment> segments);

  // In the order of the request: rows of every vector that is sampled here.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<ArmId>& arms() const { return arms_; }
  [[nodiscard]] std::size_t segment_count() const { return starts_.size(); }
  // Copies, of one and of all.
  [[nodiscard]] Segment segment(std::size_t index) const;
  [[nodiscard]] std::vector<Segment> segments() const;
  // Memory that it holds.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] Duration duration() const { return duration_; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  [[nodiscard]] const Eigen::VectorXd& goal() const { return goal_; }

  // Before zero the start at rest, from the end on the goal at rest; at a waypoint the segment that
  // begins there. `progress` is trajectory time. Allocates only when the argument has another size.
  // One binary search over the starts: about 30 ns for 7 joints and 100 waypoints.
  void sample(Duration progress, JointState& state) const;
  void sample_positions(Duration progress, Eigen::VectorXd& position) const;

  // Computes, for each segment, from its Taylor polynomial at the middle: sound but for rounding
  // (1e-12).
  [[nodiscard]] std::vector<SegmentBounds> bounds() const;
  // How far any position between two instants is at most from the line through the middle of these
  // with the velocity there: |q(t) - position - velocity (t - middle)| <= off, t from `from` to
  // `to`. Sized as it must be; sound but for rounding (1e-12).
  // Precondition: 0 <= from <= to <= duration.
  struct AboutLine {
    Eigen::VectorXd position, velocity, off;
  };
  void enclose_about_line(Duration from, Duration to, AboutLine& line) const;

 private:
  // A segment's coefficients where they lie.
  using Piece = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 6>>;
  [[nodiscard]] Piece piece(std::size_t segment) const;
  [[nodiscard]] Duration end_of(std::size_t segment) const;
  // Precondition: 0 <= progress < duration.
  [[nodiscard]] std::size_t segment_at(Duration progress) const;

  std::vector<JointId> joints_;
  std::vector<ArmId> arms_;
  // A job may have 10,000 segments: one array for all of them, and nothing that can be computed.
  std::vector<double> coefficients_;
  std::vector<Duration> starts_;  // of the segments, close together for the search
  Duration duration_;
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
};

using TrajectoryPtr = std::shared_ptr<const Trajectory>;

}  // namespace armloom

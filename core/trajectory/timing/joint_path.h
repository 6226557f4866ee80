#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace armloom {

// A way of several joints without times: q(s), 0 <= s <= length(), in pieces that are cubics of s
// and join with one direction (q is continuously differentiable; the second derivative may jump
// from piece to piece). rad, or m for prismatic joints; s in the same, roughly the length of the
// way in joint space (Euclidean). Immutable.
class JointPath {
 public:
  // The cubic spline through these points whose second derivative is continuous, and zero at both
  // ends, over the lengths of the chords. Through every point, but not on the chords: what is known
  // to be free of these need not be of it. Points that repeat the one before are left out.
  [[nodiscard]] static JointPath spline_through(const std::vector<Eigen::VectorXd>& points);
  // Straight from point to point, each corner cut by a parabola that leaves the chords no more than
  // within_m before and after the corner, and no more than half a chord, and passes the corner no
  // farther away than `within` (Euclidean, in joint space). It lies in the triangle that the corner
  // makes with its ends: Kunz and Stilman, "Time-Optimal Trajectory Generation for Path Following
  // with Bounded Acceleration and Velocity", RSS 2012, cut by arcs instead.
  [[nodiscard]] static JointPath rounded(const std::vector<Eigen::VectorXd>& points, double within);

  // Whether there are two points that are not one: else there is no path, and the makers above
  // throw std::invalid_argument.
  [[nodiscard]] static bool leads_somewhere(const std::vector<Eigen::VectorXd>& points);

  [[nodiscard]] std::size_t joints() const { return joints_; }
  [[nodiscard]] double length() const { return ends_.back(); }

  [[nodiscard]] const Eigen::VectorXd& goal() const { return goal_; }

  // Pieces: piece k goes from begin(k) to end(k).
  [[nodiscard]] std::size_t pieces() const { return ends_.size(); }
  [[nodiscard]] double begin(std::size_t piece) const {
    return piece == 0 ? 0.0 : ends_[piece - 1];
  }
  [[nodiscard]] double end(std::size_t piece) const { return ends_[piece]; }
  // Coefficients of (s - begin)^0..3, four for each joint.
  [[nodiscard]] std::span<const double> coefficients(std::size_t piece) const {
    return {coefficients_.data() + piece * joints_ * 4, joints_ * 4};
  }
  [[nodiscard]] Eigen::VectorXd position(double s) const;  // clamped to 0..length()

 private:
  explicit JointPath(const Eigen::VectorXd& goal)
      : joints_(static_cast<std::size_t>(goal.size())), goal_(goal) {}
  // Row j: the coefficients of joint j.
  void add(double length, const Eigen::Matrix<double, Eigen::Dynamic, 4>& piece);

  std::size_t joints_;
  Eigen::VectorXd goal_;  // exactly as it was given
  std::vector<double> ends_;
  std::vector<double> coefficients_;
};

}  // namespace armloom

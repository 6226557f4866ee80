#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace armloom {

// A path of several joints without times: q(s), 0 <= s <= length(), in pieces that are cubics of s.
// q is continuously differentiable; the second derivative may jump between pieces. rad, or m for
// prismatic joints; s is in the same unit, roughly the Euclidean length in joint space. Immutable.
class JointPath {
 public:
  // Returns the cubic spline through these points. Its parameter is the length along the chords;
  // its second derivative is continuous, and zero at both ends. The spline leaves the chords, so
  // collision-free chords do not prove that the spline is collision-free. Repeated points are
  // dropped.
  [[nodiscard]] static JointPath spline_through(const std::vector<Eigen::VectorXd>& points);
  // Returns straight lines from point to point, with each corner cut by a parabola. A parabola
  // replaces at most half of each chord. It passes the corner at most `within` away (Euclidean, in
  // joint space), and stays inside the triangle of the corner and its own two ends. After Kunz and
  // Stilman, "Time-Optimal Trajectory Generation for Path Following with Bounded Acceleration and
  // Velocity", RSS 2012, who use arcs.
  [[nodiscard]] static JointPath rounded(const std::vector<Eigen::VectorXd>& points, double within);

  // Returns true if the points are not all equal. Otherwise the factories above throw
  // std::invalid_argument.
  [[nodiscard]] static bool leads_somewhere(const std::vector<Eigen::VectorXd>& points);

  [[nodiscard]] std::size_t joints() const { return joints_; }
  [[nodiscard]] double length() const { return ends_.back(); }

  [[nodiscard]] const Eigen::VectorXd& goal() const { return goal_; }

  // Piece k goes from begin(k) to end(k).
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
  Eigen::VectorXd goal_;  // exactly as given
  std::vector<double> ends_;
  std::vector<double> coefficients_;
};

}  // namespace armloom

#include "core/trajectory/timing/joint_path.h"

#include <algorithm>
#include <stdexcept>

namespace armloom {
namespace {

using Points = std::vector<Eigen::VectorXd>;
using Piece = Eigen::Matrix<double, Eigen::Dynamic, 4>;

// Steps shorter than this have no direction.
constexpr double kStepMin = 1e-9;

Points without_repetitions(const Points& points) {
  Points kept;
  for (const Eigen::VectorXd& point : points) {
    if (!kept.empty() && point.size() != kept.front().size()) {
      throw std::invalid_argument("JointPath: points of different sizes");
    }
    if (kept.empty() || (point - kept.back()).norm() > kStepMin) kept.push_back(point);
  }
  const auto repeats_the_last_but_one = [&] {
    return kept.size() > 1 && (points.back() - kept[kept.size() - 2]).norm() <= kStepMin;
  };
  while (repeats_the_last_but_one()) kept.pop_back();
  if (!kept.empty()) kept.back() = points.back();
  return kept;
}

Points corners_of(const Points& points) {
  Points kept = without_repetitions(points);
  if (kept.size() < 2) throw std::invalid_argument("JointPath: it goes nowhere");
  return kept;
}

// Returns the second derivatives of the natural cubic spline, with a column for each knot (de Boor,
// "A Practical Guide to Splines", IV).
Eigen::MatrixXd second_derivatives(const Points& q, const std::vector<double>& h) {
  const std::size_t n = q.size();
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(q.front().size(), static_cast<Eigen::Index>(n));
  std::vector<double> diagonal(n, 1.0);
  const auto col = [&](std::size_t i) { return m.col(static_cast<Eigen::Index>(i)); };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    diagonal[i] = 2.0 * (h[i - 1] + h[i]);
    col(i) = 6.0 * ((q[i + 1] - q[i]) / h[i] - (q[i] - q[i - 1]) / h[i - 1]);
    if (i == 1) continue;
    const double factor = h[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * h[i - 1];
    col(i) -= factor * col(i - 1);
  }
  for (std::size_t i = n - 1; i-- > 1;) {
    if (i + 2 < n) col(i) -= h[i] * col(i + 1);
    col(i) /= diagonal[i];
  }
  return m;
}

}  // namespace

void JointPath::add(double length, const Piece& piece) {
  ends_.push_back((ends_.empty() ? 0.0 : ends_.back()) + length);
  for (Eigen::Index j = 0; j < piece.rows(); ++j) {
    for (Eigen::Index k = 0; k < 4; ++k) coefficients_.push_back(piece(j, k));
  }
}

JointPath JointPath::spline_through(const Points& points) {
  const Points q = corners_of(points);
  std::vector<double> h;
  for (std::size_t i = 0; i + 1 < q.size(); ++i) h.push_back((q[i + 1] - q[i]).norm());
  const Eigen::MatrixXd m = second_derivatives(q, h);
  JointPath path(q.back());
  Piece piece(q.front().size(), 4);
  for (std::size_t i = 0; i + 1 < q.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    piece.col(0) = q[i];
    piece.col(1) = (q[i + 1] - q[i]) / h[i] - h[i] / 6.0 * (2.0 * m.col(at) + m.col(at + 1));
    piece.col(2) = m.col(at) / 2.0;
    piece.col(3) = (m.col(at + 1) - m.col(at)) / (6.0 * h[i]);
    path.add(h[i], piece);
  }
  return path;
}

JointPath JointPath::rounded(const Points& points, double within) {
  const Points q = corners_of(points);
  JointPath path(q.back());
  Piece piece = Piece::Zero(q.front().size(), 4);
  const auto chord = [&](std::size_t i) { return (q[i + 1] - q[i]).norm(); };
  double cut = 0.0;  // length of the chord replaced by the previous corner's parabola
  for (std::size_t i = 0; i + 1 < q.size(); ++i) {
    const Eigen::VectorXd direction = (q[i + 1] - q[i]) / chord(i);
    double next_cut = 0.0;
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(direction.size());
    if (i + 2 < q.size()) {
      turn = (q[i + 2] - q[i + 1]) / chord(i + 1) - direction;
      // The parabola's middle is a quarter of cut * |turn| away from the corner.
      next_cut = 0.5 * std::min(chord(i), chord(i + 1));
      if (turn.norm() * next_cut > 4.0 * within) next_cut = 4.0 * within / turn.norm();
    }
    if (const double straight = chord(i) - cut - next_cut; straight > kStepMin) {
      piece.setZero();
      piece.col(0) = q[i] + cut * direction;
      piece.col(1) = direction;
      path.add(straight, piece);
    }
    if (next_cut > 0.0) {
      piece.setZero();
      piece.col(0) = q[i + 1] - next_cut * direction;
      piece.col(1) = direction;
      piece.col(2) = turn / (4.0 * next_cut);
      path.add(2.0 * next_cut, piece);
    }
    cut = next_cut;
  }
  return path;
}

Eigen::VectorXd JointPath::position(double s) const {
  s = std::clamp(s, 0.0, length());
  const auto found = std::min(std::ranges::lower_bound(ends_, s), ends_.end() - 1);
  const auto k = static_cast<std::size_t>(found - ends_.begin());
  const double x = s - begin(k);
  const auto c = coefficients(k);
  Eigen::VectorXd q(static_cast<Eigen::Index>(joints_));
  for (std::size_t j = 0; j < joints_; ++j) {
    const double* of = c.data() + 4 * j;
    q[static_cast<Eigen::Index>(j)] = of[0] + x * (of[1] + x * (of[2] + x * of[3]));
  }
  return q;
}

bool JointPath::leads_somewhere(const std::vector<Eigen::VectorXd>& points) {
  return without_repetitions(points).size() > 1;
}

}  // namespace armloom

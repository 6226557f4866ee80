#include "core/trajectory/timing/path_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace armloom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A limit of the form |on_u u + on_x x| <= limit, with x = s'^2 at the part's beginning and u = s''
// in the part. Solved for u, it is |u + slope x| <= half. A limit with on_u = 0 bounds only x
// (Part::x_begin).
struct Row {
  double slope;
  double half;
};

// The part of the path between two stations. It has a Row for each joint and Bernstein coefficient.
struct Part {
  double begin;
  double length;
  std::size_t piece;
  std::size_t rows_begin;
  double x_max = kInfinity;    // largest x at both ends, from velocity limits
  double x_begin = kInfinity;  // largest x at the beginning, from limits with on_u = 0
};

// The interval of allowed u, and the derivative of each bound by x.
struct Range {
  double lowest = -kInfinity;
  double highest = kInfinity;
  double lowest_slope = 0.0;
  double highest_slope = 0.0;
};

class Reachability {
 public:
  Reachability(const JointPath& path, const JointRates& rates, std::size_t parts);
  [[nodiscard]] std::vector<Station> solve();

 private:
  void add_part(const JointPath& path, const JointRates& rates, Part part);
  [[nodiscard]] std::span<const Row> rows(std::size_t part) const {
    const std::size_t end = part + 1 < parts_.size() ? parts_[part + 1].rows_begin : rows_.size();
    return {rows_.data() + parts_[part].rows_begin, rows_.data() + end};
  }
  [[nodiscard]] Range range_of_u(std::size_t part, double x) const;
  [[nodiscard]] double largest_x(std::size_t part, double x_next) const;

  std::vector<Part> parts_;
  std::vector<Row> rows_;
};

Reachability::Reachability(const JointPath& path, const JointRates& rates, std::size_t parts) {
  constexpr std::size_t kPartsOfPiece = 6;
  for (std::size_t k = 0; k < path.pieces(); ++k) {
    const double length = path.end(k) - path.begin(k);
    const double share = length / path.length() * static_cast<double>(parts);
    const std::size_t count = std::max(kPartsOfPiece, static_cast<std::size_t>(std::ceil(share)));
    for (std::size_t i = 0; i < count; ++i) {
      const double each = length / static_cast<double>(count);
      add_part(path, rates, {static_cast<double>(i) * each, each, k, rows_.size()});
    }
  }
}

// Adds a part with its rows. Let y = (s - begin) / length, from 0 to 1 in the part, and
//   q = c0 + c1 y + c2 y^2 + c3 y^3.
// Then s'^2 = x + 2 u length y, and length^2 q'' is a quadratic of y:
//   u length (c1 + 2 c2 y + 3 c3 y^2) + (x + 2 u length y)(2 c2 + 6 c3 y) =: w0 + w1 y + w2 y^2.
void Reachability::add_part(const JointPath& path, const JointRates& rates, Part part) {
  const auto of = path.coefficients(part.piece);
  const double h = part.length;
  const double b = part.begin;
  for (std::size_t j = 0; j < path.joints(); ++j) {
    const double* p = of.data() + 4 * j;
    // Coefficients of the piece's cubic as a function of y (0 to 1 over the part).
    const double c1 = h * (p[1] + b * (2.0 * p[2] + 3.0 * b * p[3]));
    const double c2 = h * h * (p[2] + 3.0 * b * p[3]);
    const double c3 = h * h * h * p[3];
    const auto row = static_cast<Eigen::Index>(j);
    const double steepest =
        std::max({std::abs(c1), std::abs(c1 + c2), std::abs(c1 + 2.0 * c2 + 3.0 * c3)}) / h;
    if (steepest > 0.0) {
      const double speed = rates.velocity[row] / steepest;
      part.x_max = std::min(part.x_max, speed * speed);
    }
    const double limit = rates.acceleration[row] * h * h;
    const double u0 = h * c1, u1 = h * 6.0 * c2, u2 = h * 15.0 * c3;  // factors of u in w0, w1, w2
    const double x0 = 2.0 * c2, x1 = 6.0 * c3;                        // factors of x in w0, w1
    // A quadratic's Bernstein coefficients are w0, w0 + w1 / 2, w0 + w1 + w2.
    const auto add_row = [&](double on_u, double on_x) {
      if (std::abs(on_u) >= 1e-12 * limit) {
        rows_.push_back({on_x / on_u, limit / std::abs(on_u)});
      } else if (on_x != 0.0) {
        part.x_begin = std::min(part.x_begin, limit / std::abs(on_x));
      }
    };
    add_row(u0, x0);
    if (c2 == 0.0 && c3 == 0.0) continue;
    add_row(u0 + u1 / 2.0, x0 + x1 / 2.0);
    add_row(u0 + u1 + u2, x0 + x1);
  }
  parts_.push_back(part);
}

Range Reachability::range_of_u(std::size_t part, double x) const {
  Range range;
  for (const Row& row : rows(part)) {
    const double middle = -row.slope * x;
    if (middle + row.half < range.highest) {
      range.highest = middle + row.half;
      range.highest_slope = -row.slope;
    }
    if (middle - row.half > range.lowest) {
      range.lowest = middle - row.half;
      range.lowest_slope = -row.slope;
    }
  }
  return range;
}

// Returns the largest x from which some u keeps all limits of the part and leads to at most x_next
// at the part's end. lowest(x) is convex and highest(x) concave, so Newton's steps from above on
// their piecewise linear difference reach the intersection and never pass it.
double Reachability::largest_x(std::size_t part, double x_next) const {
  const double twice = 2.0 * parts_[part].length;
  double x = std::min(parts_[part].x_max, parts_[part].x_begin);
  for (int i = 0; i < 60; ++i) {
    const Range range = range_of_u(part, x);
    const double to_next = (x_next - x) / twice;
    const bool by_next = to_next < range.highest;
    const double highest = by_next ? to_next : range.highest;
    if (range.lowest - highest <= 1e-9 * (std::abs(range.lowest) + std::abs(highest))) break;
    const double fall = range.lowest_slope - (by_next ? -1.0 / twice : range.highest_slope);
    if (!(fall > 0.0)) return 0.0;
    x = std::max(0.0, x - (range.lowest - highest) / fall);
    if (x == 0.0) break;
  }
  return x;
}

std::vector<Station> Reachability::solve() {
  const std::size_t n = parts_.size();
  std::vector<double> reach(n + 1, 0.0);  // largest x from which the motion can rest at the end
  for (std::size_t i = n; i-- > 0;)
    reach[i] = std::min(largest_x(i, reach[i + 1]), i > 0 ? parts_[i - 1].x_max : kInfinity);
  std::vector<Station> stations;
  double s = 0.0, x = 0.0, t = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Range range = range_of_u(i, x);
    const double length = parts_[i].length;
    const double u =
        std::max(std::min(range.highest, (reach[i + 1] - x) / (2.0 * length)), -x / (2.0 * length));
    const double x_next = i + 1 == n ? 0.0 : std::max(0.0, x + 2.0 * length * u);
    const double speed = std::sqrt(x);
    stations.push_back({s, speed, t, parts_[i].piece, (x_next - x) / (2.0 * length)});
    t += 2.0 * length / (speed + std::sqrt(x_next));
    s += length;
    x = x_next;
  }
  stations.push_back({s, 0.0, t, stations.back().piece, 0.0});
  return stations;
}

}  // namespace

std::vector<Station> fastest_along(const JointPath& path, const JointRates& rates,
                                   std::size_t parts) {
  return Reachability(path, rates, parts).solve();
}

}  // namespace armloom

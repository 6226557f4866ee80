#include "core/trajectory/polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armloom {
namespace {

using Bernstein = std::array<double, kDegree + 1>;

// Rows of Pascal's triangle, C(n, k).
constexpr double kBinomial[kDegree + 1][kDegree + 1] = {
    {1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0}, {1, 2, 1, 0, 0, 0},
    {1, 3, 3, 1, 0, 0}, {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1},
};

// Returns p(t + shift_s) by Horner steps.
Polynomial shifted(Polynomial p, double shift_s) {
  for (int i = 0; i < kDegree; ++i) {
    for (int k = kDegree - 1; k >= i; --k) {
      p[static_cast<std::size_t>(k)] += shift_s * p[static_cast<std::size_t>(k) + 1];
    }
  }
  return p;
}

// Returns the Bernstein coefficients of p on [0, duration_s]:
//   b[i] = sum over k <= i of C(i, k) / C(n, k) * c[k] duration^k.
// Polynomials of lower degree are also written in degree 5, which only tightens the bounds.
Bernstein bernstein(const Polynomial& p, double duration_s) {
  std::array<double, kDegree + 1> scaled{};
  double power = 1.0;
  for (std::size_t k = 0; k <= kDegree; ++k) {
    scaled[k] = p[k] * power / kBinomial[kDegree][k];
    power *= duration_s;
  }
  Bernstein b{};
  for (std::size_t i = 0; i <= kDegree; ++i) {
    for (std::size_t k = 0; k <= i; ++k) b[i] += kBinomial[i][k] * scaled[k];
  }
  return b;
}

// Bisects by de Casteljau's algorithm. It only averages, so that rounding errors do not grow.
void halve(const Bernstein& b, Bernstein& left, Bernstein& right) {
  right = b;
  for (std::size_t i = 0; i <= kDegree; ++i) {
    left[i] = right[0];
    for (std::size_t k = 0; k + i < kDegree; ++k) right[k] = 0.5 * (right[k] + right[k + 1]);
  }
}

double slack(double value) { return kLimitSlack * std::max(1.0, std::abs(value)); }

// Finds the largest value above a limit by branch and bound. Skips parts whose bound is not above
// the largest value reached so far.
class Maximum {
 public:
  explicit Maximum(double limit) : best_(limit + slack(limit)) {}

  void search(const Bernstein& b, double from_s, double to_s, int depth = 0) {
    reach(b.front(), from_s);
    reach(b.back(), to_s);
    const double bound = *std::max_element(b.begin(), b.end());
    if (bound <= best_ + slack(best_)) return;
    const double middle_s = 0.5 * (from_s + to_s);
    if (depth == kDepthMax) return reach(bound, middle_s);  // undecided: counts as exceeded
    Bernstein left;
    Bernstein right;
    halve(b, left, right);
    search(left, from_s, middle_s, depth + 1);
    search(right, middle_s, to_s, depth + 1);
  }
  [[nodiscard]] const std::optional<Extreme>& found() const { return found_; }

 private:
  // The gap between bound and value shrinks by a factor of four at each level, so this is enough
  // for any slack.
  static constexpr int kDepthMax = 60;

  void reach(double value, double t_s) {
    if (value <= best_) return;
    best_ = value;
    found_ = Extreme{t_s, value};
  }

  double best_;
  std::optional<Extreme> found_;
};

}  // namespace

Polynomial cubic(const KnotState& from, const KnotState& to, double duration_s) {
  const double T = duration_s;
  const double rise = to.position - from.position;
  return {from.position,
          from.velocity,
          (3.0 * rise - (2.0 * from.velocity + to.velocity) * T) / (T * T),
          ((from.velocity + to.velocity) * T - 2.0 * rise) / (T * T * T),
          0.0,
          0.0};
}

Polynomial quintic(const KnotState& from, const KnotState& to, double duration_s) {
  const double T = duration_s;
  const double T3 = T * T * T;
  const double rise = to.position - from.position;
  const double v0 = from.velocity * T;
  const double v1 = to.velocity * T;
  const double a0 = from.acceleration * T * T;
  const double a1 = to.acceleration * T * T;
  return {from.position,
          from.velocity,
          0.5 * from.acceleration,
          (20.0 * rise - 12.0 * v0 - 8.0 * v1 - 3.0 * a0 + a1) / (2.0 * T3),
          (-30.0 * rise + 16.0 * v0 + 14.0 * v1 + 3.0 * a0 - 2.0 * a1) / (2.0 * T3 * T),
          (12.0 * rise - 6.0 * (v0 + v1) - a0 + a1) / (2.0 * T3 * T * T)};
}

double evaluate(const Polynomial& p, double t_s) {
  double value = p[kDegree];
  for (std::size_t k = kDegree; k-- > 0;) value = value * t_s + p[k];
  return value;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d{};
  for (std::size_t k = 0; k < kDegree; ++k) d[k] = static_cast<double>(k + 1) * p[k + 1];
  return d;
}

double magnitude(const Polynomial& p, double t_s) {
  double value = std::abs(p[kDegree]);
  for (std::size_t k = kDegree; k-- > 0;) value = value * t_s + std::abs(p[k]);
  return value;
}

Bounds bounds(const Polynomial& p, double from_s, double to_s) {
  const Bernstein b = bernstein(shifted(p, from_s), to_s - from_s);
  // A coefficient has fewer than 32 roundings, each at most half an epsilon of a partial sum, and
  // no partial sum exceeds the magnitude.
  const double rounding = 32.0 * std::numeric_limits<double>::epsilon() * magnitude(p, to_s);
  const auto [lowest, highest] = std::minmax_element(b.begin(), b.end());
  return {*lowest - rounding, *highest + rounding};
}

std::optional<Extreme> worst_outside(const Polynomial& p, double duration_s,
                                     const Bounds& allowed) {
  // A fast test: most polynomials are far inside.
  const double swing = magnitude(p, duration_s) - std::abs(p[0]);
  if (p[0] - swing >= allowed.lower && p[0] + swing <= allowed.upper) return std::nullopt;

  Bernstein b = bernstein(p, duration_s);
  const auto [lowest, highest] = std::minmax_element(b.begin(), b.end());
  if (*lowest >= allowed.lower && *highest <= allowed.upper) return std::nullopt;

  Maximum above(allowed.upper);
  above.search(b, 0.0, duration_s);
  for (double& coefficient : b) coefficient = -coefficient;
  Maximum below(-allowed.lower);
  below.search(b, 0.0, duration_s);

  std::optional<Extreme> lower = below.found();
  if (lower) lower->value = -lower->value;
  if (!above.found()) return lower;
  if (!lower) return above.found();
  const bool above_is_worse = above.found()->value - allowed.upper >= allowed.lower - lower->value;
  return above_is_worse ? above.found() : lower;
}

}  // namespace armloom

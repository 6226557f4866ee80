#pragma once

#include <array>
#include <optional>

namespace armloom {

// One joint's piece of a trajectory: p(t) = sum of c[k] t^k, k = 0..5, with t in seconds since the
// piece began; p in rad (m for prismatic joints). A polynomial of lower degree has zeros at the
// end.
inline constexpr int kDegree = 5;
using Polynomial = std::array<double, kDegree + 1>;

// State at one end of a piece; rad, rad/s, rad/s^2.
struct KnotState {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;  // ignored by cubic()
};

// Returns the only cubic (quintic) with these states at t = 0 and t = duration_s: Hermite
// interpolation, as in ROS's joint_trajectory_controller. Precondition: duration_s > 0. If the
// input is extreme, coefficients may overflow to infinity or NaN; check magnitude().
[[nodiscard]] Polynomial cubic(const KnotState& from, const KnotState& to, double duration_s);
[[nodiscard]] Polynomial quintic(const KnotState& from, const KnotState& to, double duration_s);

[[nodiscard]] double evaluate(const Polynomial& p, double t_s);
[[nodiscard]] Polynomial derivative(const Polynomial& p);

// Returns sum of |c[k]| t^k, t_s >= 0: a bound of |p| on [-t_s, t_s]. Not finite if a coefficient
// is not, or if the sum overflows.
[[nodiscard]] double magnitude(const Polynomial& p, double t_s);

struct Bounds {
  double lower;
  double upper;
};

// Encloses every value of p on [from_s, to_s], rounding included: the range of the Bernstein
// coefficients there (Farouki 2012), widened by their rounding error. The gap to the true range
// shrinks with the square of the interval's length. Precondition: 0 <= from_s <= to_s, magnitude(p,
// to_s) finite.
[[nodiscard]] Bounds bounds(const Polynomial& p, double from_s, double to_s);

struct Extreme {
  double t_s;
  double value;  // of p at t_s
};

// Returns the time in [0, duration_s] at which p is farthest outside of `allowed`, or nullopt if p
// stays inside. Decides by bounds, never by samples. Divides the interval until each part is proven
// to be inside, or its bound is less than kLimitSlack away from a value that p reaches. (The slack
// is relative for values above 1, else absolute.) So an accepted p exceeds `allowed` by at most 2
// kLimitSlack, and a refused p really exceeds it. The bounds of `allowed` may be infinite.
// Precondition: duration_s >= 0, magnitude(p, duration_s) finite.
inline constexpr double kLimitSlack = 1e-9;
[[nodiscard]] std::optional<Extreme> worst_outside(const Polynomial& p, double duration_s,
                                                   const Bounds& allowed);

}  // namespace armloom

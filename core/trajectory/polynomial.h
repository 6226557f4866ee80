#pragma once

#include <array>
#include <optional>

namespace armloom {

// One joint's piece of a trajectory: p(t) = sum of c[k] t^k, k = 0..5, with t in seconds since the
// piece began; p in rad (m for prismatic joints). Lower degrees have zeros at the end.
inline constexpr int kDegree = 5;
using Polynomial = std::array<double, kDegree + 1>;

// What is asked for at one end of a piece; rad, rad/s, rad/s^2.
struct KnotState {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;  // not read by cubic()
};

// The only cubic (quintic) with these states at t = 0 and t = duration_s: Hermite interpolation,
// as ROS's joint_trajectory_controller does it. Precondition: duration_s > 0. For extreme input the
// coefficients may overflow to infinity or NaN; magnitude() says so.
[[nodiscard]] Polynomial cubic(const KnotState& from, const KnotState& to, double duration_s);
[[nodiscard]] Polynomial quintic(const KnotState& from, const KnotState& to, double duration_s);

[[nodiscard]] double evaluate(const Polynomial& p, double t_s);
[[nodiscard]] Polynomial derivative(const Polynomial& p);

// sum of |c[k]| t^k, t_s >= 0: no value of p on [-t_s, t_s] is larger. Not finite where p has a
// coefficient that is not, or overflows.
[[nodiscard]] double magnitude(const Polynomial& p, double t_s);

struct Bounds {
  double lower;
  double upper;
};

// Encloses every value of p on [from_s, to_s], rounding included: the range of the Bernstein
// coefficients there (p is a convex combination of them, Farouki 2012), widened by the rounding
// error of computing them. The gap to the true range shrinks with the square of the interval.
// Precondition: 0 <= from_s <= to_s, magnitude(p, to_s) finite.
[[nodiscard]] Bounds bounds(const Polynomial& p, double from_s, double to_s);

struct Extreme {
  double t_s;
  double value;  // of p at t_s
};

// Where p leaves `allowed` furthest on [0, duration_s]; nothing if it does not leave it. Decided on
// bounds, never on samples: subdivides until each part is proven inside or less than kLimitSlack
// (relative above 1, else absolute) away from a value that is reached. So what is accepted exceeds
// by at most 2 kLimitSlack, and what is refused does exceed. Bounds may be infinite.
// Precondition: duration_s >= 0, magnitude(p, duration_s) finite.
inline constexpr double kLimitSlack = 1e-9;
[[nodiscard]] std::optional<Extreme> worst_outside(const Polynomial& p, double duration_s,
                                                   const Bounds& allowed);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

// Independent reference distances. Points are projected alternately on both shapes, in closed form,
// until the gap to a separating plane is closed.
namespace armloom::reference {

struct Convex {
  enum class Kind { box, cylinder, capsule } kind;        // a sphere is a capsule of length zero
  Eigen::Vector3d half_size_m = Eigen::Vector3d::Zero();  // box
  double radius_m = 0.0;
  double half_length_m = 0.0;  // along z, without a capsule's caps
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
};

inline Eigen::Vector3d project_local(const Convex& c, const Eigen::Vector3d& p) {
  if (c.kind == Convex::Kind::box) return p.cwiseMin(c.half_size_m).cwiseMax(-c.half_size_m);
  const double z = std::clamp(p.z(), -c.half_length_m, c.half_length_m);
  if (c.kind == Convex::Kind::cylinder) {
    const double r = std::hypot(p.x(), p.y());
    const double scale = r > c.radius_m ? c.radius_m / r : 1.0;
    return {p.x() * scale, p.y() * scale, z};
  }
  const Eigen::Vector3d core(0, 0, z);
  const double d = (p - core).norm();
  return d <= c.radius_m ? p : Eigen::Vector3d(core + (p - core) * (c.radius_m / d));
}

inline Eigen::Vector3d project(const Convex& c, const Eigen::Vector3d& p_W) {
  return c.X_WS * project_local(c, c.X_WS.inverse() * p_W);
}

// Returns the largest n·(x - center) over the shape; n has unit length.
inline double support(const Convex& c, const Eigen::Vector3d& n_W) {
  const Eigen::Vector3d n = c.X_WS.linear().transpose() * n_W;
  if (c.kind == Convex::Kind::box) return n.cwiseAbs().dot(c.half_size_m);
  const double along = std::abs(n.z()) * c.half_length_m;
  if (c.kind == Convex::Kind::cylinder) return along + std::hypot(n.x(), n.y()) * c.radius_m;
  return along + c.radius_m;
}

// The true distance lies in [lower, upper]; both are at most zero in contact.
struct Bracket {
  double lower;
  double upper;
};

inline constexpr double kTouching_m = 1e-9;
inline constexpr double kClosed_m = 1e-8;

// Returns true if the bracket cannot close within `rounds_left` rounds at the rate of the last
// `window` rounds.
inline bool is_hopeless(const Bracket& before, const Bracket& now, int window, int rounds_left) {
  const auto windows = [](double last, double current, double target) {
    return current >= last ? 1e9 : std::log(current / target) / std::log(last / current);
  };
  const double needed =
      std::min(windows(before.upper, now.upper, kTouching_m),
               windows(before.upper - before.lower, now.upper - now.lower, kClosed_m));
  return needed * window > rounds_left;
}

// Runs at most `rounds` rounds. Stops earlier if more rounds would not help.
inline Bracket distance(const Convex& a, const Convex& b, int rounds = 20000) {
  constexpr int kWindow = 100;
  Eigen::Vector3d on_a = project(a, b.X_WS.translation());
  Bracket best{-1e9, 1e9};
  Bracket before = best;
  for (int i = 0; i < rounds; ++i) {
    if (i % kWindow == kWindow - 1) {
      if (i > kWindow && is_hopeless(before, best, kWindow, rounds - i)) break;
      before = best;
    }
    const Eigen::Vector3d on_b = project(b, on_a);
    const Eigen::Vector3d gap = on_b - on_a;
    best.upper = std::min(best.upper, gap.norm());
    if (best.upper < kTouching_m) return {0.0, 0.0};
    const Eigen::Vector3d n = gap.normalized();
    const double lower =
        n.dot(b.X_WS.translation() - a.X_WS.translation()) - support(a, n) - support(b, n);
    best.lower = std::max(best.lower, lower);
    if (best.upper - best.lower < kClosed_m) break;
    on_a = project(a, on_b);
  }
  return best;
}

inline Eigen::Isometry3d random_pose(std::mt19937_64& random, double reach_m) {
  std::uniform_real_distribution<double> place(-reach_m, reach_m);
  std::normal_distribution<double> turn;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const Eigen::Quaterniond R(turn(random), turn(random), turn(random), turn(random));
  X.linear() = R.normalized().toRotationMatrix();
  X.translation() = Eigen::Vector3d(place(random), place(random), place(random));
  return X;
}

}  // namespace armloom::reference

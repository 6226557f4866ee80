#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <vector>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// A joint that carries a body: its axis in the world at the configuration at hand, and how far the
// joint may be from there: by s * drift + e, the same s of all joints of the body from -1 to 1 (the
// motion is a line in joint space, nearly), and |e| <= loose.
struct MovingAxis {
  Eigen::Vector3d z_W;
  Eigen::Vector3d p_WO;  // a point of the axis; not read where it is prismatic
  double loose;          // rad, m
  bool prismatic;
  double drift = 0.0;

  [[nodiscard]] double span() const { return std::abs(drift) + loose; }
};

// How far a body may reach along one direction n, wherever the joints that carry it are within
// their spans: much less than the sum of spans times levers, which counts every motion as if it
// went along n.
//
// With the axes at hand, base to tip, a point that stands at p when all joints are where they are
// here stands at E_1 E_2 ... E_k p when joint j is off by d_j, E_j its turn or shift about its axis
// as it is here (the product of exponentials: Murray, Li and Sastry, "A Mathematical Introduction
// to Robotic Manipulation", 3.2). The sum over j of E_1 .. E_j-1 (E_j - 1) p is how far that is
// from p. With r = p - p_WO, for a turn (E - 1) p = sin d (z x r) + (1 - cos d) z x (z x r), and
// E_1 .. E_j-1 turns a vector v by at most the sum of their |d_i|, so moves it by at most that
// times |v|. Hence along n at most
//   sum_j s_j |n . (z_j x r_j)|  +  sum_j s_j l_j (s_j / 2 + sum_{i<j} s_i),   l_j = |z_j x r_j|,
// for |d_j| <= s_j of any size; of a shift |n . z_j| takes the place of the first factor, 1 that of
// l_j, and its own s_j does not turn. Where d_j = s drift_j + e_j, the first sum is at most
//   |sum_j drift_j n . (z_j x r_j)| + sum_j loose_j |n . (z_j x r_j)|:
// joints that move against each other take from each other. It is convex in p: over a convex shape
// it is largest in a corner.
class Sweep {
 public:
  // n of unit length; axes base to tip, which must outlive the sweep.
  Sweep(std::span<const MovingAxis> axes, const Eigen::Vector3d& n_W);

  // At least the largest n . x over a shape, wherever the joints are.
  [[nodiscard]] double reach(const ConvexShape& shape, const PlacedConvexShape& placed) const;
  // The same over all points within radius_m of the hull of these.
  [[nodiscard]] double reach(std::span<const Eigen::Vector3d> p_W, double radius_m) const;
  // At least the largest n . (x - p) over the points p of the hull and x within radius_m of where p
  // comes to be.
  [[nodiscard]] double overestimate(std::span<const Eigen::Vector3d> p_W, double radius_m) const;

 private:
  struct Moment {       // of an axis that turns
    Eigen::Vector3d m;  // s (n x z): s n . (z x (p - o)) = m . p - offset
    double offset;
  };
  [[nodiscard]] double added(const Eigen::Vector3d& p_W) const;
  [[nodiscard]] double at(const Eigen::Vector3d& p_W) const;
  [[nodiscard]] double of_cylinder(const ConvexShape& shape, const PlacedConvexShape& placed) const;
  [[nodiscard]] double of_box(const ConvexShape& shape, const PlacedConvexShape& placed) const;
  [[nodiscard]] double of_hull(const ConvexShape& shape, const PlacedConvexShape& placed) const;
  [[nodiscard]] double round(double radius_m) const;
  [[nodiscard]] double remainder(const Eigen::Vector3d& center_W, double radius_m) const;

  std::span<const MovingAxis> axes_;
  Eigen::Vector3d n_;
  std::vector<Moment> moments_;                 // of what is loose
  Moment drift_{Eigen::Vector3d::Zero(), 0.0};  // of all drifts together, shifts too
  double shifts_m_ = 0.0;                       // loose, of the prismatic joints, along n
  double turn_ = 0.0;  // how far all of it may slope: the sum of |m| over whole spans
};

}  // namespace armloom

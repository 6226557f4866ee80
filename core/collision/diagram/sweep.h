#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/geometry/convex/convex_shape.h"

namespace armloom {

// A joint that moves a body, with its axis in the world at the present configuration. The joint may
// deviate from this configuration by s * drift + e, where |e| <= loose. s, from -1 to 1, is the
// same for all joints of the body, because the motion is nearly a line in joint space.
struct MovingAxis {
  Eigen::Vector3d z_W;
  Eigen::Vector3d p_WO;  // a point of the axis; unused if prismatic
  double loose;          // rad, or m if prismatic; so is drift
  bool prismatic;
  double drift = 0.0;

  [[nodiscard]] double span() const { return std::abs(drift) + loose; }
};

// Bounds how far a body may reach along a direction n, for all joint values within the spans. Much
// tighter than the sum of spans times levers, which assumes that every joint moves the body along
// n.
//
// With axes base to tip, a point p moves to E_1 E_2 ... E_k p if each joint j deviates by d_j. E_j
// turns about the present axis j, or shifts along it (product of exponentials: Murray, Li and
// Sastry, "A Mathematical Introduction to Robotic Manipulation", 3.2). The displacement of p is the
// sum over j of E_1 .. E_j-1 (E_j - 1) p. For a turn, with r = p - p_WO,
//   (E - 1) p = sin d (z x r) + (1 - cos d) z x (z x r).
// E_1 .. E_j-1 move a vector v by at most |v| times the sum of their |d_i|. Hence, for |d_j| <= s_j
// of any size, the displacement along n is at most
//   sum_j s_j |n . (z_j x r_j)|  +  sum_j s_j l_j (s_j / 2 + sum_{i<j} s_i),   l_j = |z_j x r_j|.
// For a shift, |n . z_j| replaces the first factor and 1 replaces l_j. A shift turns nothing, so
// its s_j / 2, and its s_j in the sums of later joints, are 0. With d_j = s drift_j + e_j, the
// first sum is at most
//   |sum_j drift_j n . (z_j x r_j)| + sum_j loose_j |n . (z_j x r_j)|.
// In this bound, joints that move against each other cancel. The bound is convex in p, so it is
// largest at a corner of a convex shape.
class Sweep {
 public:
  // n has unit length; axes are base to tip and must outlive the Sweep.
  Sweep(std::span<const MovingAxis> axes, const Eigen::Vector3d& n_W);

  // Returns an upper bound of n . x over all points x of a shape, for all joint values.
  [[nodiscard]] double reach(const ConvexShape& shape, const PlacedConvexShape& placed) const;
  // Returns the same bound over all points within radius_m of the convex hull of `p_W`.
  [[nodiscard]] double reach(std::span<const Eigen::Vector3d> p_W, double radius_m) const;
  // Returns an upper bound of n . (x - p) over all points p of the convex hull of `p_W`, and all
  // points x within radius_m of a place to which p may move.
  [[nodiscard]] double overestimate(std::span<const Eigen::Vector3d> p_W, double radius_m) const;

 private:
  struct Moment {       // of an axis that turns
    Eigen::Vector3d m;  // s (n x z); with o on the axis, s n . (z x (p - o)) = m . p - offset
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
  // Moments of the loose parts, on the stack for arms of usual length: sweeps are short-lived.
  alignas(Moment) std::array<std::byte, 12 * sizeof(Moment)> memory_;
  std::pmr::monotonic_buffer_resource resource_{memory_.data(), memory_.size()};
  std::pmr::vector<Moment> moments_{&resource_};
  Moment drift_{Eigen::Vector3d::Zero(), 0.0};  // of all drifts together, shifts included
  double shifts_m_ = 0.0;                       // loose parts of the prismatic joints, along n
  double turn_ = 0.0;                           // bound of the sum of |m|, if s is the whole span
};

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/ball.h"

namespace armloom {

// All points within radius_m of the segment from A to B (a ball when they are one), in the frame P
// of a part.
struct LinkCapsule {
  Eigen::Vector3d p_PA = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_PB = Eigen::Vector3d::Zero();
  double radius_m = 0.0;

  [[nodiscard]] double volume_m3() const;
};

// Distance of a point from the capsule's segment; exactly 0 at its ends.
[[nodiscard]] double distance_to_axis(const LinkCapsule& capsule, const Eigen::Vector3d& p);

// Whether the ball lies in the capsule (a convex shape spanned by balls does when they do), with
// rounding on the safe side: a no may be wrong by some 1e-15 of the coordinates, a yes never.
[[nodiscard]] bool contains(const LinkCapsule& capsule, const Ball& ball);

// A capsule around the balls that is small in volume: the best of the start directions and the
// principal axes, improved by a pattern search over the line's direction and place; with the line
// given, radius and ends follow in closed form. The same balls give the same capsule. It contains
// every ball (checked; its radius is at most 1e-11 of the coordinates larger than it must be for
// its segment).
// `thorough` false: only the starts are tried, for comparing many groups of balls.
// Precondition: at least one ball.
[[nodiscard]] LinkCapsule fit_capsule(const std::vector<Ball>& balls,
                                      const std::vector<Eigen::Vector3d>& directions,
                                      bool thorough = true);

// The balls that reach farthest in some 60 directions: enough to compare capsules by.
[[nodiscard]] std::vector<Ball> outermost(const std::vector<Ball>& balls);

}  // namespace armloom

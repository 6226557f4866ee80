#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/ball.h"

namespace armloom {

// The set of all points within radius_m of the segment AB, in the frame P of a part (a link or an
// object). A and B may be equal.
struct LinkCapsule {
  Eigen::Vector3d p_PA = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_PB = Eigen::Vector3d::Zero();
  double radius_m = 0.0;

  [[nodiscard]] double volume_m3() const;
};

// Returns the distance (m) of p from the segment AB; exactly 0 if p is A or B.
[[nodiscard]] double distance_to_axis(const LinkCapsule& capsule, const Eigen::Vector3d& p);

// Returns true if the ball lies in the capsule. A capsule is convex, so it also contains the convex
// hull of all balls that it contains. True is certain. False may be wrong if the ball is inside by
// less than a few 1e-15 of the coordinates.
[[nodiscard]] bool contains(const LinkCapsule& capsule, const Ball& ball);

// Returns a capsule of small volume that contains every ball (checked). Tries axes along
// `directions` and along the principal axes of the balls. If `thorough`, improves the best two by a
// pattern search. For each axis, the radius and the ends follow in closed form. The radius exceeds
// the least radius for these ends by at most 1e-11 of the coordinates. Deterministic. Precondition:
// at least one ball.
[[nodiscard]] LinkCapsule fit_capsule(const std::vector<Ball>& balls,
                                      const std::vector<Eigen::Vector3d>& directions,
                                      bool thorough = true);

// Returns only the balls that reach farthest in one of 60 directions. These are enough to compare
// candidate capsules.
[[nodiscard]] std::vector<Ball> outermost(const std::vector<Ball>& balls);

}  // namespace armloom

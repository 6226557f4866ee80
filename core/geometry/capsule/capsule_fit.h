#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/ball.h"

namespace armloom {

// All points within radius_m of the segment AB (may be a point), in a part's frame P.
struct LinkCapsule {
  Eigen::Vector3d p_PA = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_PB = Eigen::Vector3d::Zero();
  double radius_m = 0.0;

  [[nodiscard]] double volume_m3() const;
};

// Returns the distance of p from the segment; exactly 0 at its ends.
[[nodiscard]] double distance_to_axis(const LinkCapsule& capsule, const Eigen::Vector3d& p);

// Returns true if the ball lies in the capsule. If several balls do, so does their convex hull.
// True is certain; false may be wrong by about 1e-15 of the coordinates.
[[nodiscard]] bool contains(const LinkCapsule& capsule, const Ball& ball);

// Returns a capsule of small volume that contains every ball (checked). Tries lines along
// `directions` and the principal axes; if `thorough`, improves the best by a pattern search. Radius
// and ends follow from the line in closed form; the radius exceeds its minimum by at most 1e-11 of
// the coordinates. Deterministic. Precondition: at least one ball.
[[nodiscard]] LinkCapsule fit_capsule(const std::vector<Ball>& balls,
                                      const std::vector<Eigen::Vector3d>& directions,
                                      bool thorough = true);

// Returns the balls that reach farthest in 60 directions, to compare capsules.
[[nodiscard]] std::vector<Ball> outermost(const std::vector<Ball>& balls);

}  // namespace armloom

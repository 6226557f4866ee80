#pragma once

#include <span>
#include <vector>

#include "core/collision/diagram/sweep.h"
#include "core/collision/state/body_distance.h"
#include "core/geometry/surface/solid.h"

namespace armloom {

// A body and the joints that may move it, base to tip. For two bodies of one arm, omit the joints
// upstream of both, because they do not change the distance of the two bodies.
struct MovingBody {
  PlacedBody at;
  std::span<const MovingAxis> axes;
};

// Returns true if the bodies are proven to keep limit_m for all joint values within the spans. For
// each pair of shapes or surface triangles, a direction must be found along which the two stay
// limit_m apart (Sweep). Pairs that are enough_m apart in the present configuration are skipped:
// the caller must know that they keep limit_m.
// A true answer is always right. Precondition: the bodies do not touch in the present configuration
// (body_distance() > 0).
[[nodiscard]] bool keep_apart(const std::vector<ConvexShape>& shapes, const MovingBody& a,
                              const MovingBody& b, double limit_m, double enough_m);

// Returns the same for the surfaces of two solids. Precondition: in the present configuration,
// neither solid lies inside the other.
struct MovingSolid {
  PlacedSolid at;
  std::span<const MovingAxis> axes;
};
[[nodiscard]] bool surfaces_keep_apart(const MovingSolid& a, const MovingSolid& b, double limit_m,
                                       double enough_m);

// Returns a lower bound of the gap between two shapes along the unit vector n_W (from a to b), for
// all joint values within the spans; may be negative.
struct MovingShape {
  const ConvexShape& shape;
  const PlacedConvexShape& at;
  std::span<const MovingAxis> axes;
};
[[nodiscard]] double swept_gap(const MovingShape& a, const MovingShape& b,
                               const Eigen::Vector3d& n_W);

}  // namespace armloom

#pragma once

#include <span>
#include <vector>

#include "core/collision/diagram/sweep.h"
#include "core/collision/state/body_distance.h"
#include "core/geometry/surface/solid.h"

namespace armloom {

// A body and the joints that may move it, base to tip. For two bodies of one arm, omit joints
// upstream of both, which do not change their distance.
struct MovingBody {
  PlacedBody at;
  std::span<const MovingAxis> axes;
};

// Returns true if the bodies are proven to keep limit_m for all joint values within the spans. Each
// pair of shapes or surface triangles needs a direction along which the two stay limit_m apart
// (Sweep). Pairs that are enough_m apart here are skipped; the caller must know that this suffices.
// Never wrongly true. Precondition: the bodies are apart here (body_distance() > 0).
[[nodiscard]] bool keep_apart(const std::vector<ConvexShape>& shapes, const MovingBody& a,
                              const MovingBody& b, double limit_m, double enough_m);

// The same for two surfaces. Precondition: neither lies inside the other here.
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

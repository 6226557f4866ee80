#pragma once

#include <span>
#include <vector>

#include "core/collision/diagram/sweep.h"
#include "core/collision/state/body_distance.h"
#include "core/geometry/surface/solid.h"

namespace armloom {

// A body somewhere in the world, and the joints that may move it, base to tip. Of two bodies of one
// arm those joints only that carry one of them: what carries both does not part them.
struct MovingBody {
  PlacedBody at;
  std::span<const MovingAxis> axes;
};

// Whether two bodies are proven to keep limit_m wherever these joints are within their spans: for
// each two shapes, or triangles of surfaces, there is a direction across which one never reaches
// within limit_m of the other (Sweep). Those that are enough_m apart already are not looked at;
// that this is enough is the caller's to know. May say no where yes is true, never the reverse.
// Precondition: they are apart here (body_distance() is above zero).
[[nodiscard]] bool keep_apart(const std::vector<ConvexShape>& shapes, const MovingBody& a,
                              const MovingBody& b, double limit_m, double enough_m);

// The same of two surfaces. Precondition: neither is inside of the other here.
struct MovingSolid {
  PlacedSolid at;
  std::span<const MovingAxis> axes;
};
[[nodiscard]] bool surfaces_keep_apart(const MovingSolid& a, const MovingSolid& b, double limit_m,
                                       double enough_m);

// The gap along n (of unit length, from a to b) that two shapes keep so; negative: they may
// overlap.
struct MovingShape {
  const ConvexShape& shape;
  const PlacedConvexShape& at;
  std::span<const MovingAxis> axes;
};
[[nodiscard]] double swept_gap(const MovingShape& a, const MovingShape& b,
                               const Eigen::Vector3d& n_W);

}  // namespace armloom

#include "core/collision/state/body_distance.h"

#include <algorithm>
#include <limits>

#include "core/collision/state/shape_groups.h"

namespace armloom {
namespace {

constexpr double kFound = -std::numeric_limits<double>::max();  // below every limit

// Returns min(distance of the convex shapes of both groups, limit_m). If one group has pieces of a
// mesh, returns the first distance that is small enough to query the surface.
double shapes_distance(const std::vector<ConvexShape>& shapes, const ShapeGroups& a,
                       const ShapeGroups& b, double limit_m) {
  constexpr std::size_t kAtOnce = 4;  // shapes of b that are placed at once
  const bool pieces = a.are_pieces() || b.are_pieces();
  double smallest = limit_m;
  PlacedConvexShape at_a;
  PlacedConvexShape at_b[kAtOnce];
  for (std::size_t begin = b.begin(); begin < b.end(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, b.end());
    for (std::size_t j = begin; j < end; ++j) b.place(j, at_b[j - begin]);
    for (std::size_t i = a.begin(); i < a.end(); ++i) {
      a.place(i, at_a);
      for (std::size_t j = begin; j < end; ++j) {
        smallest = distance_below(shapes[i], at_a, shapes[j], at_b[j - begin], smallest);
        if (pieces && smallest < std::min(limit_m, kSurfaceWithin_m)) return smallest;
      }
    }
  }
  return smallest;
}

// Returns min(distance of both bodies, limit_m). If pieces of a mesh are too close, of_solids(a, b,
// within_m) returns the distance of the two solids.
template <class OfSolids>
double smallest_distance(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                         const PlacedBody& b, double limit_m, const OfSolids& of_solids) {
  const bool plain = !a.body.has_pieces && !b.body.has_pieces;
  double smallest = limit_m;
  for (ShapeGroups of_a(shapes, a, plain); !of_a.ended(); of_a.next()) {
    for (ShapeGroups of_b(shapes, b, plain); !of_b.ended(); of_b.next()) {
      const double distance_m = shapes_distance(shapes, of_a, of_b, smallest);
      if (distance_m >= smallest) continue;
      const bool pieces = of_a.are_pieces() || of_b.are_pieces();
      if (!pieces || distance_m >= kSurfaceWithin_m) {
        smallest = distance_m;
        continue;
      }
      const double within_m = std::min(smallest, kSurfaceWithin_m);
      smallest = of_solids(of_a.solid(), of_b.solid(), within_m);
    }
  }
  return smallest;
}

}  // namespace

double body_distance(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                     const PlacedBody& b, double limit_m, const Roughness& of_surfaces) {
  const auto distance = [&](const PlacedSolid& of_a, const PlacedSolid& of_b, double within_m) {
    return solid_distance(of_a, of_b, within_m, of_surfaces);
  };
  return smallest_distance(shapes, a, b, limit_m, distance);
}

bool bodies_surely_closer_than(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                               const PlacedBody& b, double limit_m) {
  for (ShapeGroups of_a(shapes, a); !of_a.ended(); of_a.next()) {
    for (ShapeGroups of_b(shapes, b); !of_b.ended(); of_b.next()) {
      if (surely_closer_than(of_a.solid(), of_b.solid(), limit_m)) {
        return true;
      }
    }
  }
  return false;
}

std::size_t limits_kept(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                        const PlacedBody& b, std::span<const double> limits_m) {
  const bool plain = !a.body.has_pieces && !b.body.has_pieces;
  std::size_t kept = limits_m.size();
  for (ShapeGroups of_a(shapes, a, plain); !of_a.ended(); of_a.next()) {
    for (ShapeGroups of_b(shapes, b, plain); !of_b.ended() && kept > 0; of_b.next()) {
      const double distance_m = shapes_distance(shapes, of_a, of_b, limits_m[kept - 1]);
      const bool pieces = of_a.are_pieces() || of_b.are_pieces();
      const bool asks_surfaces = pieces && distance_m < kSurfaceWithin_m;
      const auto is_below = [&](double limit_m) {
        if (distance_m >= limit_m) return false;
        if (!asks_surfaces || limit_m > kSurfaceWithin_m) return true;
        return closer_than(of_a.solid(), of_b.solid(), limit_m);
      };
      while (kept > 0 && is_below(limits_m[kept - 1])) --kept;
    }
  }
  return kept;
}

bool bodies_closer_than(const std::vector<ConvexShape>& shapes, const PlacedBody& a,
                        const PlacedBody& b, double limit_m) {
  const auto found = [](const PlacedSolid& of_a, const PlacedSolid& of_b, double within_m) {
    return closer_than(of_a, of_b, within_m) ? kFound : within_m;
  };
  return smallest_distance(shapes, a, b, limit_m, found) < limit_m;
}

}  // namespace armloom

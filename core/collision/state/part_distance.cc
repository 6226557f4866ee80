#include "core/collision/state/part_distance.h"

#include <algorithm>
#include <limits>

#include "core/collision/state/part_groups.h"

namespace armloom {
namespace {

constexpr double kFound = -std::numeric_limits<double>::max();  // no limit is closer

// Of the convex bodies; where pieces are among them, the first that is close enough to ask their
// surface.
double bodies_distance(const std::vector<ConvexShape>& bodies, const PartGroups& a,
                       const PartGroups& b, double limit_m) {
  const bool pieces = a.are_pieces() || b.are_pieces();
  double smallest = limit_m;
  PlacedConvexShape own_a;
  PlacedConvexShape own_b;
  for (std::size_t i = a.begin(); i < a.end(); ++i) {
    const PlacedConvexShape& at_a = a.placed(i, own_a);
    for (std::size_t j = b.begin(); j < b.end(); ++j) {
      smallest = distance_below(bodies[i], at_a, bodies[j], b.placed(j, own_b), smallest);
      if (pieces && smallest < std::min(limit_m, kSurfaceWithin_m)) return smallest;
    }
  }
  return smallest;
}

// `of_solids`(a, X_WA, b, X_WB, limit): what is to be known of two solids.
template <class OfSolids>
double smallest_distance(const std::vector<ConvexShape>& bodies, const PlacedPart& a,
                         const PlacedPart& b, double limit_m, const OfSolids& of_solids) {
  double smallest = limit_m;
  for (PartGroups of_a(bodies, a); !of_a.ended(); of_a.next()) {
    for (PartGroups of_b(bodies, b); !of_b.ended(); of_b.next()) {
      const double distance_m = bodies_distance(bodies, of_a, of_b, smallest);
      if (distance_m >= smallest) continue;
      const bool pieces = of_a.are_pieces() || of_b.are_pieces();
      if (!pieces || distance_m >= kSurfaceWithin_m) {
        smallest = distance_m;
        continue;
      }
      const double within_m = std::min(smallest, kSurfaceWithin_m);
      smallest = of_solids(of_a.solid(), of_a.X_WT(), of_b.solid(), of_b.X_WT(), within_m);
    }
  }
  return smallest;
}

}  // namespace

double part_distance(const std::vector<ConvexShape>& bodies, const PlacedPart& a,
                     const PlacedPart& b, double limit_m) {
  return smallest_distance(bodies, a, b, limit_m, solid_distance);
}

double part_distance(const PlanningScene::Bodies& bodies, std::size_t part_a,
                     const Eigen::Isometry3d& X_WA, std::size_t part_b,
                     const Eigen::Isometry3d& X_WB, double limit_m) {
  return part_distance(bodies.bodies, {bodies.parts[part_a], X_WA}, {bodies.parts[part_b], X_WB},
                       limit_m);
}

bool parts_surely_closer_than(const std::vector<ConvexShape>& bodies, const PlacedPart& a,
                              const PlacedPart& b, double limit_m) {
  for (PartGroups of_a(bodies, a); !of_a.ended(); of_a.next()) {
    for (PartGroups of_b(bodies, b); !of_b.ended(); of_b.next()) {
      if (surely_closer_than(of_a.solid(), of_a.X_WT(), of_b.solid(), of_b.X_WT(), limit_m)) {
        return true;
      }
    }
  }
  return false;
}

bool parts_closer_than(const std::vector<ConvexShape>& bodies, const PlacedPart& a,
                       const PlacedPart& b, double limit_m) {
  const auto found = [](const Solid& of_a, const Eigen::Isometry3d& X_WA, const Solid& of_b,
                        const Eigen::Isometry3d& X_WB, double within_m) {
    return closer_than(of_a, X_WA, of_b, X_WB, within_m) ? kFound : within_m;
  };
  return smallest_distance(bodies, a, b, limit_m, found) < limit_m;
}

}  // namespace armloom

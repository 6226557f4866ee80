#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/capsule/segment_distance.h"
#include "core/geometry/convex/hull_shape.h"
#include "core/geometry/shape.h"
#include "core/geometry/surface/solid.h"

namespace armloom {

class ExactGeometry;

enum class ConvexShapeKind {
  round,     // sphere or capsule: all points within radius of a segment
  cylinder,  // flat ends
  box,
  hull,  // of a mesh, or of a piece of one
};

// One convex shape of a part (a link or an object), fixed in the part's frame P.
struct ConvexShape {
  ConvexShapeKind kind = ConvexShapeKind::round;
  Eigen::Isometry3d X_PS = Eigen::Isometry3d::Identity();  // axis along z of S
  double half_length_m = 0.0;  // of the axis; zero for spheres and boxes; of a hull's capsule
  double radius_m = 0.0;       // about the axis; of a box: of its bounding sphere
  Eigen::Vector3d half_size_m = Eigen::Vector3d::Zero();  // of a box, or the box around a hull
  Eigen::Vector3d p_SE_P = Eigen::Vector3d::Zero();       // from the centre to the axis' upper end
  std::shared_ptr<const HullShape> hull;                  // hulls only
  std::shared_ptr<const ExactGeometry> exact;
  SolidPtr solid;         // what it stands for; pieces of one mesh have the same
  bool is_piece = false;  // of a closed mesh: the solid is less than the body

  // Of the bounding sphere about the origin of S.
  [[nodiscard]] double bounding_radius_m() const { return half_length_m + radius_m; }
};

// The bodies of a link or object. A cylinder with a sphere of its radius centred at both ends
// (within kMergeTolerance_m) becomes one capsule that contains all three; the spheres are dropped,
// also when two cylinders share one. A mesh becomes its convex pieces, or its hull when it has
// none; where it is closed they stand for its surface. Everything else stays as it is.
// Precondition: meshes hold their data.
inline constexpr double kMergeTolerance_m = 1e-6;
[[nodiscard]] std::vector<ConvexShape> make_convex_shapes(const std::vector<PlacedShape>& shapes);

// Where a body is in the world: its segment, and its full pose unless it is round.
struct PlacedConvexShape {
  CenteredSegment segment;
  Eigen::Isometry3d X_WS;  // not filled for round bodies
};
[[nodiscard]] Eigen::Isometry3d shape_pose(const ConvexShape& body,
                                           const PlacedConvexShape& placed);
void place(const ConvexShape& body, const Eigen::Isometry3d& X_WP, PlacedConvexShape& placed);

// A distance that the true one cannot fall below, from the segments alone.
struct Bound {
  double distance_m;  // negative: depth of overlap, at least
  bool exact;         // it is the distance itself
};
[[nodiscard]] Bound lower_bound(const ConvexShape& a, const PlacedConvexShape& at_a,
                                const ConvexShape& b, const PlacedConvexShape& at_b);

// Two bodies with a gap of distance_m between two planes across n, of unit length from a to b.
// Nothing where none is found, as in contact; the distance, or at least enough_m.
struct Separation {
  double distance_m;
  Eigen::Vector3d n_W;
};
[[nodiscard]] std::optional<Separation> separation(const ConvexShape& a,
                                                   const PlacedConvexShape& at_a,
                                                   const ConvexShape& b,
                                                   const PlacedConvexShape& at_b, double enough_m);

// min(distance, limit_m): cheap when the bound is not below the limit. Negative or zero in contact.
[[nodiscard]] double distance_below(const ConvexShape& a, const PlacedConvexShape& at_a,
                                    const ConvexShape& b, const PlacedConvexShape& at_b,
                                    double limit_m);

}  // namespace armloom

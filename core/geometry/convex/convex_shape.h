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
  hull,  // convex hull of a mesh or of a convex piece of it
};

// One convex shape of a part (a link or an object), fixed in the part's frame P.
struct ConvexShape {
  ConvexShapeKind kind = ConvexShapeKind::round;
  Eigen::Isometry3d X_PS = Eigen::Isometry3d::Identity();  // the shape's frame S; z is the axis
  // Half the axis (hull: of the capsule around it); zero for spheres and boxes.
  double half_length_m = 0.0;
  double radius_m = 0.0;  // distance of the surface from the axis; box: bounding sphere
  // Half the sides of the box, or of the box around the hull.
  Eigen::Vector3d half_size_m = Eigen::Vector3d::Zero();
  // From the center S to the upper end E of the axis.
  Eigen::Vector3d p_SE_P = Eigen::Vector3d::Zero();
  std::shared_ptr<const HullShape> hull;  // hulls only
  std::shared_ptr<const ExactGeometry> exact;
  SolidPtr solid;         // the true shape; the pieces of one mesh share one solid
  bool is_piece = false;  // a piece of a closed mesh: `solid` is the whole mesh, not this hull

  // Radius of the bounding sphere about the origin of S.
  [[nodiscard]] double bounding_radius_m() const { return half_length_m + radius_m; }
};

// Returns the convex bodies of a link or object.
// - A cylinder with a sphere of its radius at each end (within kMergeTolerance_m) becomes one
//   capsule that contains all three. The spheres are dropped, even if shared.
// - A mesh becomes its convex pieces, or its hull if it has no pieces. If the mesh is closed, its
//   surface becomes the `solid` of all its pieces.
// - Every other shape is kept.
// Precondition: every mesh has its data.
inline constexpr double kMergeTolerance_m = 1e-6;
[[nodiscard]] std::vector<ConvexShape> make_convex_shapes(const std::vector<PlacedShape>& shapes);

// A convex shape's position in the world W: its axis and, unless it is round, its pose.
struct PlacedConvexShape {
  CenteredSegment segment;
  Eigen::Isometry3d X_WS;  // not filled for round shapes
};
[[nodiscard]] Eigen::Isometry3d shape_pose(const ConvexShape& body,
                                           const PlacedConvexShape& placed);
void place(const ConvexShape& body, const Eigen::Isometry3d& X_WP, PlacedConvexShape& placed);

// A lower bound of the distance of two shapes, computed only from their axes and boxes.
struct Bound {
  double distance_m;  // negative if the bounding volumes overlap
  bool exact;         // distance_m is the distance itself
};
[[nodiscard]] Bound lower_bound(const ConvexShape& a, const PlacedConvexShape& at_a,
                                const ConvexShape& b, const PlacedConvexShape& at_b);

// Two parallel planes that separate two shapes. distance_m is the gap between the planes; n_W is
// their unit normal, from a to b, in the world frame.
struct Separation {
  double distance_m;
  Eigen::Vector3d n_W;
};
// Returns planes whose gap is the distance of the shapes, or at least enough_m. Returns nullopt if
// no planes are found, for example in contact.
[[nodiscard]] std::optional<Separation> separation(const ConvexShape& a,
                                                   const PlacedConvexShape& at_a,
                                                   const ConvexShape& b,
                                                   const PlacedConvexShape& at_b, double enough_m);

// Returns min(distance, limit_m); at most zero in contact. Cheap if lower_bound() reaches limit_m.
[[nodiscard]] double distance_below(const ConvexShape& a, const PlacedConvexShape& at_a,
                                    const ConvexShape& b, const PlacedConvexShape& at_b,
                                    double limit_m);

}  // namespace armloom

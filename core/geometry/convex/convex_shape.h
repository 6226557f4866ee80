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
  hull,  // of a mesh or a piece
};

// One convex shape of a part (a link or an object), fixed in the part's frame P.
struct ConvexShape {
  ConvexShapeKind kind = ConvexShapeKind::round;
  Eigen::Isometry3d X_PS = Eigen::Isometry3d::Identity();  // axis along z of S
  double half_length_m = 0.0;  // of the axis; zero for spheres and boxes; of a hull's capsule
  double radius_m = 0.0;       // about the axis; box: radius of its bounding sphere
  Eigen::Vector3d half_size_m = Eigen::Vector3d::Zero();  // of the box, or the box around the hull
  Eigen::Vector3d p_SE_P = Eigen::Vector3d::Zero();       // from the center to the axis' upper end
  std::shared_ptr<const HullShape> hull;                  // hulls only
  std::shared_ptr<const ExactGeometry> exact;
  SolidPtr solid;         // the real body; shared by the pieces of one mesh
  bool is_piece = false;  // of a closed mesh: the solid is less than this hull

  // Radius of the bounding sphere about the origin of S.
  [[nodiscard]] double bounding_radius_m() const { return half_length_m + radius_m; }
};

// Returns the convex bodies of a link or object.
// - A cylinder with a sphere of its radius at each end (within kMergeTolerance_m) becomes one
//   capsule that contains all three. The spheres are dropped, even if shared.
// - A mesh becomes its convex pieces, else its hull. If closed, its surface is their `solid`.
// - Every other shape is kept.
// Precondition: meshes have their data.
inline constexpr double kMergeTolerance_m = 1e-6;
[[nodiscard]] std::vector<ConvexShape> make_convex_shapes(const std::vector<PlacedShape>& shapes);

// Position in the world: the segment, and the full pose unless round.
struct PlacedConvexShape {
  CenteredSegment segment;
  Eigen::Isometry3d X_WS;  // not filled for round bodies
};
[[nodiscard]] Eigen::Isometry3d shape_pose(const ConvexShape& body,
                                           const PlacedConvexShape& placed);
void place(const ConvexShape& body, const Eigen::Isometry3d& X_WP, PlacedConvexShape& placed);

// A lower bound of the distance, from segments and boxes alone.
struct Bound {
  double distance_m;  // negative if the bounding volumes overlap
  bool exact;         // distance_m is the distance itself
};
[[nodiscard]] Bound lower_bound(const ConvexShape& a, const PlacedConvexShape& at_a,
                                const ConvexShape& b, const PlacedConvexShape& at_b);

// Finds two parallel planes that separate the bodies: the gap is their distance, or at least
// enough_m; n_W is the unit normal from a to b. Returns nullopt if none is found, as in contact.
struct Separation {
  double distance_m;
  Eigen::Vector3d n_W;
};
[[nodiscard]] std::optional<Separation> separation(const ConvexShape& a,
                                                   const PlacedConvexShape& at_a,
                                                   const ConvexShape& b,
                                                   const PlacedConvexShape& at_b, double enough_m);

// Returns min(distance, limit_m); at most zero in contact. Cheap if lower_bound() reaches limit_m.
[[nodiscard]] double distance_below(const ConvexShape& a, const PlacedConvexShape& at_a,
                                    const ConvexShape& b, const PlacedConvexShape& at_b,
                                    double limit_m);

}  // namespace armloom

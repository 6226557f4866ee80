#include "core/geometry/convex/convex_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "core/geometry/convex/exact_distance.h"
#include "core/geometry/convex/gjk.h"
#include "core/geometry/convex/solid_of_shape.h"
#include "core/geometry/mesh/mesh.h"

namespace armloom {
namespace {

ConvexShape hull_body(const Eigen::Isometry3d& X_PM, const ConvexHull& hull_M) {
  ConvexShape body;
  body.kind = ConvexShapeKind::hull;
  body.hull = std::make_shared<const HullShape>(fit_hull(hull_M));
  body.X_PS = X_PM * body.hull->X_MS;
  body.half_length_m = body.hull->half_length_m;
  body.radius_m = body.hull->radius_m;
  body.half_size_m = body.hull->half_size_m;
  return body;
}

ConvexShape primitive_body(const PlacedShape& placed) {
  ConvexShape body;
  body.X_PS = placed.X_LS;
  if (const auto* box = std::get_if<Box>(&placed.shape)) {
    body.kind = ConvexShapeKind::box;
    body.half_size_m = 0.5 * box->size_m;
    body.radius_m = body.half_size_m.norm();
  } else if (const auto* cylinder = std::get_if<Cylinder>(&placed.shape)) {
    body.kind = ConvexShapeKind::cylinder;
    body.half_length_m = 0.5 * cylinder->length_m;
    body.radius_m = cylinder->radius_m;
  } else {
    body.kind = ConvexShapeKind::round;
    body.radius_m = std::get<Sphere>(placed.shape).radius_m;
  }
  return body;
}

// Adds the bodies of one shape. Cylinders and the spheres at their ends are merged later.
void add_plain_bodies(const PlacedShape& placed, std::vector<ConvexShape>& bodies) {
  const auto* mesh = std::get_if<Mesh>(&placed.shape);
  if (mesh == nullptr) {
    bodies.push_back(primitive_body(placed));
    return;
  }
  const std::size_t first = bodies.size();
  if (mesh->data->pieces.empty()) bodies.push_back(hull_body(placed.X_LS, mesh->data->hull));
  for (const ConvexHull& piece_M : mesh->data->pieces) {
    bodies.push_back(hull_body(placed.X_LS, piece_M));
  }
  if (!mesh->data->surface) return;
  const auto solid = std::make_shared<const Solid>(
      Solid{mesh->data->surface, placed.X_LS, 0.0, InnerBalls(inner_balls(*mesh->data->surface))});
  for (std::size_t i = first; i < bodies.size(); ++i) {
    bodies[i].solid = solid;
    bodies[i].is_piece = true;
  }
}

bool is_sphere(const ConvexShape& body) {
  return body.kind == ConvexShapeKind::round && body.half_length_m == 0.0;
}

// Returns the index of a sphere with the cylinder's radius at its upper (`end` = 1) or lower (-1)
// end, or nullopt if there is no such sphere.
std::optional<std::size_t> cap_at(const std::vector<ConvexShape>& bodies,
                                  const ConvexShape& cylinder, double end) {
  const Eigen::Vector3d p_end = cylinder.X_PS * Eigen::Vector3d(0, 0, end * cylinder.half_length_m);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (is_sphere(bodies[i]) &&
        std::abs(bodies[i].radius_m - cylinder.radius_m) <= kMergeTolerance_m &&
        (bodies[i].X_PS.translation() - p_end).norm() <= kMergeTolerance_m) {
      return i;
    }
  }
  return std::nullopt;
}

// Returns the radius that a capsule about the cylinder's axis needs to contain the cylinder and the
// sphere `cap` at its end.
double radius_with(const ConvexShape& cylinder, double end, const ConvexShape& cap) {
  const Eigen::Vector3d p_end = cylinder.X_PS * Eigen::Vector3d(0, 0, end * cylinder.half_length_m);
  return std::max(cylinder.radius_m, cap.radius_m + (cap.X_PS.translation() - p_end).norm());
}

// Returns the distance (m) of a segment in the world frame from a box, or from the box around a
// hull.
double segment_to_box(const PlacedConvexShape& at_box, const ConvexShape& box,
                      const CenteredSegment& segment) {
  const auto R_BW = at_box.X_WS.linear().transpose();
  return segment_box_distance(
      {R_BW * (segment.center - at_box.X_WS.translation()), R_BW * segment.half}, box.half_size_m);
}

// Returns the widest gap between two boxes along their six face normals. These are six of the
// fifteen possible separating axes.
double face_gap(const ConvexShape& a, const PlacedConvexShape& at_a, const ConvexShape& b,
                const PlacedConvexShape& at_b) {
  const Eigen::Matrix3d R_AB = at_a.X_WS.linear().transpose() * at_b.X_WS.linear();
  const Eigen::Matrix3d width = R_AB.cwiseAbs();
  const Eigen::Vector3d p = at_b.X_WS.translation() - at_a.X_WS.translation();
  const Eigen::Vector3d p_A = at_a.X_WS.linear().transpose() * p;
  const Eigen::Vector3d p_B = at_b.X_WS.linear().transpose() * p;
  const Eigen::Vector3d gap_A = p_A.cwiseAbs() - a.half_size_m - width * b.half_size_m;
  const Eigen::Vector3d gap_B = p_B.cwiseAbs() - b.half_size_m - width.transpose() * a.half_size_m;
  return std::max(gap_A.maxCoeff(), gap_B.maxCoeff());
}

bool has_box(const ConvexShape& body) {
  return body.kind == ConvexShapeKind::box || body.kind == ConvexShapeKind::hull;
}

// Returns a lower bound of the distance if a or b is a hull: the better of the bounds from the
// hull's capsule and from its box.
double bound_of_hull(const ConvexShape& a, const PlacedConvexShape& at_a, const ConvexShape& b,
                     const PlacedConvexShape& at_b) {
  if (a.kind != ConvexShapeKind::hull) return bound_of_hull(b, at_b, a, at_a);
  if (b.kind == ConvexShapeKind::box) {
    return std::max(segment_to_box(at_b, b, at_a.segment) - a.radius_m, face_gap(a, at_a, b, at_b));
  }
  const double capsules =
      segment_segment_distance(at_a.segment, at_b.segment) - a.radius_m - b.radius_m;
  const double boxes =
      has_box(b) ? face_gap(a, at_a, b, at_b) : segment_to_box(at_a, a, at_b.segment) - b.radius_m;
  return std::max(capsules, boxes);
}

}  // namespace

std::vector<ConvexShape> make_convex_shapes(const std::vector<PlacedShape>& shapes) {
  std::vector<ConvexShape> bodies;
  for (const PlacedShape& shape : shapes) add_plain_bodies(shape, bodies);
  const std::vector<ConvexShape> plain = bodies;
  std::vector<bool> dropped(bodies.size(), false);
  for (ConvexShape& body : bodies) {
    if (body.kind != ConvexShapeKind::cylinder) continue;
    const auto upper = cap_at(plain, body, 1.0);
    const auto lower = cap_at(plain, body, -1.0);
    if (!upper || !lower) continue;
    body.radius_m =
        std::max(radius_with(body, 1.0, plain[*upper]), radius_with(body, -1.0, plain[*lower]));
    body.kind = ConvexShapeKind::round;
    dropped[*upper] = dropped[*lower] = true;
  }
  std::vector<ConvexShape> kept;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (dropped[i]) continue;
    bodies[i].p_SE_P = bodies[i].X_PS.linear().col(2) * bodies[i].half_length_m;
    bodies[i].exact = make_exact_geometry(bodies[i]);
    if (!bodies[i].solid) bodies[i].solid = solid_of(bodies[i]);
    kept.push_back(std::move(bodies[i]));
  }
  return kept;
}

void place(const ConvexShape& body, const Eigen::Isometry3d& X_WP, PlacedConvexShape& placed) {
  if (body.kind == ConvexShapeKind::round) {
    placed.segment.center.noalias() = X_WP.linear() * body.X_PS.translation();
    placed.segment.center += X_WP.translation();
    placed.segment.half.noalias() = X_WP.linear() * body.p_SE_P;
    return;
  }
  placed.X_WS = X_WP * body.X_PS;
  placed.segment.center = placed.X_WS.translation();
  placed.segment.half = placed.X_WS.linear().col(2) * body.half_length_m;
}

Eigen::Isometry3d shape_pose(const ConvexShape& body, const PlacedConvexShape& placed) {
  if (body.kind != ConvexShapeKind::round) return placed.X_WS;
  // Any rotation about the axis gives the same body.
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  X_WS.translation() = placed.segment.center;
  if (body.half_length_m > 0.0) {
    X_WS.linear() =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), placed.segment.half)
            .toRotationMatrix();
  }
  return X_WS;
}

Bound lower_bound(const ConvexShape& a, const PlacedConvexShape& at_a, const ConvexShape& b,
                  const PlacedConvexShape& at_b) {
  if (a.kind == ConvexShapeKind::hull || b.kind == ConvexShapeKind::hull) {
    return {bound_of_hull(a, at_a, b, at_b), false};
  }
  const bool a_box = a.kind == ConvexShapeKind::box;
  const bool b_box = b.kind == ConvexShapeKind::box;
  if (a_box && b_box) return {face_gap(a, at_a, b, at_b), false};
  if (a_box) {
    return {segment_to_box(at_a, a, at_b.segment) - b.radius_m, b.kind == ConvexShapeKind::round};
  }
  if (b_box) {
    return {segment_to_box(at_b, b, at_a.segment) - a.radius_m, a.kind == ConvexShapeKind::round};
  }
  const bool exact = a.kind == ConvexShapeKind::round && b.kind == ConvexShapeKind::round;
  return {segment_segment_distance(at_a.segment, at_b.segment) - a.radius_m - b.radius_m, exact};
}

std::optional<Separation> separation(const ConvexShape& a, const PlacedConvexShape& at_a,
                                     const ConvexShape& b, const PlacedConvexShape& at_b,
                                     double enough_m) {
  if (a.kind != ConvexShapeKind::round || b.kind != ConvexShapeKind::round) {
    const std::optional<Separation> found = gjk(a, at_a, b, at_b, enough_m);
    if (found) return found->distance_m > 0.0 ? found : std::nullopt;
    return exact_separation(a, shape_pose(a, at_a), b, shape_pose(b, at_b));
  }
  const Eigen::Vector3d gap = segment_segment_gap(at_b.segment, at_a.segment);
  const double length = gap.norm();
  const double distance_m = length - a.radius_m - b.radius_m;
  if (!(distance_m > 0.0) || !(length > 0.0)) return std::nullopt;
  return Separation{distance_m, gap / length};
}

double distance_below(const ConvexShape& a, const PlacedConvexShape& at_a, const ConvexShape& b,
                      const PlacedConvexShape& at_b, double limit_m) {
  const double reach = limit_m + a.bounding_radius_m() + b.bounding_radius_m();
  if (reach <= 0.0) return limit_m;  // no overlap is that deep
  if ((at_a.segment.center - at_b.segment.center).squaredNorm() >= reach * reach) return limit_m;
  const Bound bound = lower_bound(a, at_a, b, at_b);
  if (bound.distance_m >= limit_m) return limit_m;
  if (bound.exact) return bound.distance_m;
  const auto apart = separation(a, at_a, b, at_b, limit_m);
  return apart ? std::min(limit_m, apart->distance_m) : std::min(limit_m, 0.0);
}

}  // namespace armloom

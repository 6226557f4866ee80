#include "core/audit/audited_cell.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

namespace armloom {
namespace {

// FCL's GJK may end early and claim too much (up to 0.8 mm was measured at its default tolerance):
// nothing is concluded for later states from closer than this, and contact is asked for by itself.
constexpr double kDoubt_m = 1e-3;
constexpr double kGjkTolerance = 1e-12;
// FCL takes milliseconds for the distance of meshes, unless it may pass over what is farther than
// some bound. What is asked for beyond the distance that matters saves as much travel until the
// pair must be looked at again.
constexpr double kLookAhead_m = 0.05;

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return std::make_shared<fcl::Boxd>(box->size_m);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    return std::make_shared<fcl::Cylinderd>(cylinder->radius_m, cylinder->length_m);
  }
  return std::make_shared<fcl::Sphered>(std::get<Sphere>(shape).radius_m);
}

double radius_of(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return 0.5 * box->size_m.norm();
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    return std::hypot(cylinder->radius_m, 0.5 * cylinder->length_m);
  }
  return std::get<Sphere>(shape).radius_m;
}

bool lacks_mesh(const std::vector<PlacedShape>& shapes) {
  return std::any_of(shapes.begin(), shapes.end(), [](const PlacedShape& placed) {
    const auto* mesh = std::get_if<Mesh>(&placed.shape);
    return mesh != nullptr && mesh->data == nullptr;
  });
}

bool may_touch(const Cell& cell, const AuditedSolid& a, const AuditedSolid& b) {
  if (!a.arm && !b.arm) return true;  // nothing there can change
  if (!b.link) return cell.allowed_link_objects.count({*a.link, b.name}) > 0;
  return cell.allowed_link_pairs.count({*a.link, *b.link}) > 0;
}

bool one_arm_only(const Cell& cell, const AuditedSolid& a, const AuditedSolid& b) {
  if (!a.link || !b.link) return false;
  return a.arm ? cell.is_own(*b.link, *a.arm) : cell.is_own(*a.link, *b.arm);
}

using Element = AuditedSolid::Element;

// Surfaces that do not touch: whether one of x's pieces lies inside of y.
bool lies_inside(const Element& x, const Element& y) {
  if (y.mesh == nullptr) return false;  // FCL's primitive shapes are solid
  const Eigen::Isometry3d X_YX = y.object.getTransform().inverse() * x.object.getTransform();
  if (x.mesh == nullptr) return y.mesh->encloses(X_YX.translation());
  const std::vector<Eigen::Vector3d>& points = x.mesh->representatives();
  return std::any_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& p) { return y.mesh->encloses(X_YX * p); });
}

// min(distance, most_m)
double distance_of(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b, double most_m) {
  fcl::DistanceRequestd request;
  request.distance_tolerance = kGjkTolerance;
  // libccd, FCL's default, claims up to twice the distance of boxes that stand at one height.
  request.gjk_solver_type = fcl::GST_INDEP;
  fcl::DistanceResultd result(most_m);
  const double distance = fcl::distance(&a, &b, request, result);
  if (!(distance > 0.0)) return 0.0;
  if (distance > kDoubt_m) return distance;
  fcl::CollisionRequestd collision_request;
  fcl::CollisionResultd collision;
  return fcl::collide(&a, &b, collision_request, collision) > 0 ? 0.0 : distance;
}

}  // namespace

Result<AuditedCell> AuditedCell::build(const Cell& cell) {
  Problems problems;
  AuditedCell audited;
  const auto refuse_mesh = [&](const std::string& name) {
    problems.push_back({ProblemKind::unsupported, "mesh-not-loaded", name,
                        "the mesh of " + name + " has not been loaded"});
  };
  for (std::size_t i = 0; i < cell.links.size(); ++i) {
    const Link& link = cell.links[i];
    if (lacks_mesh(link.shapes)) {
      refuse_mesh(link.name);
      continue;
    }
    audited.add({link.name, LinkId{static_cast<std::uint32_t>(i)}, link.arm, {}}, link.shapes);
  }
  for (const CollisionObject& object : cell.objects) {
    const std::vector<PlacedShape> shapes(1, {object.shape, Eigen::Isometry3d::Identity()});
    if (lacks_mesh(shapes)) {
      refuse_mesh(object.name);
      continue;
    }
    AuditedSolid solid{object.name, std::nullopt, std::nullopt, {}};
    solid.X_WL = object.X_WO;
    audited.add(std::move(solid), shapes);
  }
  if (!problems.empty()) return failure(std::move(problems));

  for (std::size_t a = 0; a < audited.solids_.size(); ++a) {
    for (std::size_t b = a + 1; b < audited.solids_.size(); ++b) {
      const AuditedSolid& first = audited.solids_[a];
      const AuditedSolid& second = audited.solids_[b];
      if (may_touch(cell, first, second)) continue;
      audited.pairs_.push_back(
          {a, b, one_arm_only(cell, first, second), -std::numeric_limits<double>::infinity(), 0.0});
    }
  }
  return audited;
}

void AuditedCell::add(AuditedSolid solid, const std::vector<PlacedShape>& shapes) {
  if (shapes.empty()) return;
  for (const PlacedShape& placed : shapes) {
    const Element& element = solid.elements.emplace_back(make_element(placed));
    solid.radius_m = std::max(solid.radius_m, element.X_LS.translation().norm() + element.radius_m);
  }
  solids_.push_back(std::move(solid));
}

AuditedSolid::Element AuditedCell::make_element(const PlacedShape& placed) {
  const auto* mesh = std::get_if<Mesh>(&placed.shape);
  if (mesh == nullptr) {
    return {fcl::CollisionObjectd(geometry_of(placed.shape)), placed.X_LS, radius_of(placed.shape),
            nullptr};
  }
  auto audited = std::make_shared<const AuditedMesh>(*mesh->data);
  const Eigen::Isometry3d X_LC = placed.X_LS * Eigen::Translation3d(audited->p_SC());
  return {fcl::CollisionObjectd(audited->make_geometry()), X_LC, audited->radius_m(), audited};
}

void AuditedCell::move_to(const Cell& cell, const Configuration& q) {
  forward_kinematics(cell, q, X_WL_);
  for (AuditedSolid& solid : solids_) {
    if (!solid.link) continue;
    const Eigen::Isometry3d& X_WL = X_WL_[solid.link->index()];
    if (moved_once_) {
      // |(R' - R) p + (t' - t)| for every p within the radius about the link's origin.
      const double shift = (X_WL.translation() - solid.X_WL.translation()).norm();
      const double turn = (X_WL.linear() - solid.X_WL.linear()).norm();
      solid.travel_m += shift + turn * solid.radius_m;
    }
    solid.X_WL = X_WL;
    solid.elements_placed = false;
  }
  moved_once_ = true;
}

double AuditedCell::at_least(const AuditedPair& pair) const {
  const double travel = solids_[pair.a].travel_m + solids_[pair.b].travel_m;
  return pair.distance_then_m - (travel - pair.travel_then_m);
}

void AuditedCell::place_elements(AuditedSolid& solid) const {
  if (solid.elements_placed) return;
  for (AuditedSolid::Element& element : solid.elements) {
    element.object.setTransform(solid.X_WL * element.X_LS);
  }
  solid.elements_placed = true;
}

double AuditedCell::look(AuditedPair& pair, double matters_m) {
  AuditedSolid& a = solids_[pair.a];
  AuditedSolid& b = solids_[pair.b];
  place_elements(a);
  place_elements(b);
  double smallest = matters_m + kLookAhead_m;
  for (const AuditedSolid::Element& x : a.elements) {
    for (const AuditedSolid::Element& y : b.elements) {
      const double centers = (x.object.getTranslation() - y.object.getTranslation()).norm();
      if (centers - x.radius_m - y.radius_m >= smallest) continue;
      try {
        smallest = std::min(smallest, distance_of(x.object, y.object, smallest));
        if (lies_inside(x, y) || lies_inside(y, x)) smallest = 0.0;
      } catch (const std::exception&) {
        smallest = 0.0;
      }
    }
  }
  pair.distance_then_m = smallest - kDoubt_m;
  pair.travel_then_m = a.travel_m + b.travel_m;
  return smallest;
}

}  // namespace armloom

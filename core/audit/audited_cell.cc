#include "core/audit/audited_cell.h"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

namespace armloom {
namespace {

// Subtracted from a distance before later states rely on it.
constexpr double kDoubt_m = 1e-3;
// FCL needs milliseconds for meshes, unless it may ignore distances above a bound. The bound is
// this much above the relevant distance, so that the solids can travel as far before the next
// look().
constexpr double kLookAhead_m = 0.05;

bool lacks_mesh(const std::vector<PlacedShape>& shapes) {
  return std::any_of(shapes.begin(), shapes.end(), [](const PlacedShape& placed) {
    const auto* mesh = std::get_if<Mesh>(&placed.shape);
    return mesh != nullptr && mesh->data == nullptr;
  });
}

bool may_touch(const Cell& cell, const AuditedSolid& a, const AuditedSolid& b) {
  if (!a.arm && !b.arm) return true;  // neither moves
  if (!b.link) return cell.allowed.link_objects.count({*a.link, b.name}) > 0;
  // Pairs that an SRDF only claims (claimed_pairs) are checked.
  return cell.allowed.allows(*a.link, *b.link);
}

bool one_arm_only(const Cell& cell, const AuditedSolid& a, const AuditedSolid& b) {
  if (!a.link || !b.link) return false;
  return cell.is_own(*a.link, *b.link);
}

using Element = AuditedSolid::Element;

bool encloses(const Element& y, const Eigen::Vector3d& p_Y) {
  return y.mesh != nullptr ? y.mesh->encloses(p_Y) : y.primitive->contains(p_Y);
}

// Returns true if a piece of x lies inside y. Precondition: the surfaces do not touch.
bool lies_inside(const Element& x, const Element& y) {
  const Eigen::Isometry3d X_YX = y.surface.getTransform().inverse() * x.surface.getTransform();
  if (x.mesh == nullptr) return encloses(y, X_YX.translation());
  const std::vector<Eigen::Vector3d>& points = x.mesh->representatives();
  return std::any_of(points.begin(), points.end(),
                     [&](const Eigen::Vector3d& p) { return encloses(y, X_YX * p); });
}

// Returns min(distance, most_m), or zero in contact.
double distance_of(const Element& x, const Element& y, double most_m) {
  if (x.primitive != nullptr && y.primitive != nullptr) {
    const auto proven = AuditedPrimitive::proven_distance(*x.primitive, x.surface.getTransform(),
                                                          *y.primitive, y.surface.getTransform());
    if (proven) return std::min(*proven, most_m);
  }
  const double round_m = x.round_m + y.round_m;
  fcl::DistanceResultd result(most_m + round_m);
  const double distance =
      fcl::distance(&x.surface, &y.surface, fcl::DistanceRequestd(), result) - round_m;
  if (!(distance > 0.0) || lies_inside(x, y) || lies_inside(y, x)) return 0.0;
  return std::min(distance, most_m);
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
  if (const auto* mesh = std::get_if<Mesh>(&placed.shape)) {
    auto audited = std::make_shared<const AuditedMesh>(*mesh->data);
    const Eigen::Isometry3d X_LC = placed.X_LS * Eigen::Translation3d(audited->p_SC());
    return {fcl::CollisionObjectd(audited->make_surface()),
            X_LC,
            audited->radius_m(),
            0.0,
            audited,
            nullptr};
  }
  auto audited = std::make_shared<const AuditedPrimitive>(placed.shape);
  return {fcl::CollisionObjectd(audited->make_surface()),
          placed.X_LS,
          audited->radius_m(),
          audited->round_m(),
          nullptr,
          audited};
}

void AuditedCell::move_to(const Cell& cell, const Configuration& q) {
  forward_kinematics(cell, q, X_WL_);
  for (AuditedSolid& solid : solids_) {
    if (!solid.link) continue;
    const Eigen::Isometry3d& X_WL = X_WL_[solid.link->index()];
    if (moved_once_) {
      // Bounds |(R' - R) p + (t' - t)| for every p within radius_m.
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
    element.surface.setTransform(solid.X_WL * element.X_LS);
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
      const double centers = (x.surface.getTranslation() - y.surface.getTranslation()).norm();
      if (centers - x.radius_m - y.radius_m >= smallest) continue;
      try {
        smallest = std::min(smallest, distance_of(x, y, smallest));
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

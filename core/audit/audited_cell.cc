#include "core/audit/audited_cell.h"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "core/audit/touch_rules.h"

namespace armloom {
namespace {

// Subtracted from a distance before later states rely on it.
constexpr double kDoubt_m = 1e-3;
// FCL needs milliseconds for meshes, unless it may ignore distances above a bound. The bound is
// this much above the relevant distance, so that the solids can travel as far before the next
// look().
constexpr double kLookAhead_m = 0.05;
// Lower bound of a distance that has not been computed.
constexpr double kUnknown = -std::numeric_limits<double>::infinity();

bool lacks_data(const Shape& shape) {
  const auto* mesh = std::get_if<Mesh>(&shape);
  return mesh != nullptr && mesh->data == nullptr;
}

void refuse_mesh(const std::string& name, Problems& problems) {
  problems.push_back({ProblemKind::unsupported, "mesh-not-loaded", name,
                      "the mesh of " + name + " has not been loaded"});
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

Element make_element(const PlacedShape& placed) {
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

void add_elements(AuditedSolid& solid, const std::vector<PlacedShape>& shapes) {
  for (const PlacedShape& placed : shapes) {
    const Element& element = solid.elements.emplace_back(make_element(placed));
    solid.radius_m = std::max(solid.radius_m, element.X_LS.translation().norm() + element.radius_m);
  }
}

bool one_arm_only(const Cell& cell, const AuditedSolid& a, const AuditedSolid& b) {
  return a.carrier && b.carrier && cell.is_own(*a.carrier, *b.carrier);
}

}  // namespace

void find_unloaded_meshes(const RecordedScene& scene, Problems& problems) {
  for (const CollisionObject& object : scene.objects) {
    if (lacks_data(object.shape)) refuse_mesh(object.name, problems);
  }
  for (const Attachment& held : scene.held) {
    if (lacks_data(held.object.shape)) refuse_mesh(held.object.name, problems);
  }
}

Result<AuditedCell> AuditedCell::build(const Cell& cell) {
  Problems problems;
  AuditedCell audited;
  for (std::size_t i = 0; i < cell.links.size(); ++i) {
    const Link& link = cell.links[i];
    if (std::ranges::any_of(link.shapes, lacks_data, &PlacedShape::shape)) {
      refuse_mesh(link.name, problems);
      continue;
    }
    if (link.shapes.empty()) continue;
    const LinkId id{static_cast<std::uint32_t>(i)};
    AuditedSolid& solid = audited.solids_.emplace_back();
    solid.name = link.name;
    solid.link = solid.carrier = id;
    solid.arm = link.arm;
    add_elements(solid, link.shapes);
  }
  const RecordedScene first{.objects = cell.objects};
  find_unloaded_meshes(first, problems);
  if (!problems.empty()) return failure(std::move(problems));

  audited.links_end_ = audited.solids_.size();
  audited.move_to(cell, cell.home());
  audited.set_scene(cell, first);
  return audited;
}

void AuditedCell::set_scene(const Cell& cell, const RecordedScene& scene) {
  const std::vector<Place> places_before = replace_objects(cell, scene);
  replace_pairs(cell, scene, places_before);
}

std::vector<AuditedCell::Place> AuditedCell::replace_objects(const Cell& cell,
                                                             const RecordedScene& scene) {
  std::map<std::string, Place> places;  // of the objects before, by name
  for (Place i = links_end_; i < solids_.size(); ++i) places.emplace(solids_[i].name, i);
  std::vector<Place> places_before;
  for (Place i = 0; i < links_end_; ++i) places_before.push_back(i);
  std::vector<AuditedSolid> objects;
  const auto add = [&](const CollisionObject& object, const Eigen::Isometry3d& X_CO,
                       std::optional<LinkId> carrier) {
    const auto before = places.find(object.name);
    if (before != places.end() && solids_[before->second].shape == object.shape) {
      places_before.push_back(before->second);
      objects.push_back(std::move(solids_[before->second]));
      places.erase(before);
    } else {
      places_before.push_back(kNew);
      AuditedSolid& solid = objects.emplace_back();
      solid.name = object.name;
      solid.shape = object.shape;
      add_elements(solid, {{object.shape, Eigen::Isometry3d::Identity()}});
    }
    AuditedSolid& solid = objects.back();
    solid.carrier = carrier;
    solid.arm = carrier ? cell.link(*carrier).arm : std::nullopt;
    solid.X_CL = X_CO;
    move(solid);
  };
  for (const CollisionObject& object : scene.objects) add(object, object.X_WO, std::nullopt);
  for (const Attachment& held : scene.held) add(held.object, held.X_LO, held.link);
  solids_.resize(links_end_);
  std::ranges::move(objects, std::back_inserter(solids_));
  return places_before;
}

void AuditedCell::replace_pairs(const Cell& cell, const RecordedScene& scene,
                                const std::vector<Place>& places_before) {
  using Places = std::pair<Place, Place>;
  const auto places_of = [](const AuditedPair& pair) { return Places(pair.a, pair.b); };
  const TouchRules rules(cell, scene);
  const std::vector<AuditedPair> before = std::exchange(pairs_, {});
  for (Place a = 0; a < solids_.size(); ++a) {
    for (Place b = a + 1; b < solids_.size(); ++b) {
      const AuditedSolid& first = solids_[a];
      const AuditedSolid& second = solids_[b];
      const bool is_static = !first.arm && !second.arm;
      if (is_static || rules.may_touch(first, second)) continue;
      AuditedPair& pair =
          pairs_.emplace_back(AuditedPair{a, b, one_arm_only(cell, first, second), kUnknown, 0.0});
      const Places then = std::minmax(places_before[a], places_before[b]);
      const auto same = std::ranges::lower_bound(before, then, {}, places_of);
      if (same == before.end() || places_of(*same) != then) continue;
      pair.distance_then_m = same->distance_then_m;
      pair.travel_then_m = same->travel_then_m;
    }
  }
}

void AuditedCell::move_to(const Cell& cell, const Configuration& q) {
  forward_kinematics(cell, q, X_WL_);
  for (AuditedSolid& solid : solids_) {
    if (solid.carrier) move(solid);
  }
}

// Moves the solid to where its carrier is.
void AuditedCell::move(AuditedSolid& solid) const {
  const Eigen::Isometry3d X_WL =
      solid.carrier ? X_WL_[solid.carrier->index()] * solid.X_CL : solid.X_CL;
  // Bounds |(R' - R) p + (t' - t)| for every p within radius_m.
  const double shift = (X_WL.translation() - solid.X_WL.translation()).norm();
  const double turn = (X_WL.linear() - solid.X_WL.linear()).norm();
  solid.travel_m += shift + turn * solid.radius_m;
  solid.X_WL = X_WL;
  solid.elements_placed = false;
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

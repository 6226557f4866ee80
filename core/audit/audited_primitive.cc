#include "core/audit/audited_primitive.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/audit/triangle_model.h"

namespace armloom {
namespace {

using Eigen::Vector3d;

constexpr double kGjkTolerance = 1e-12;
constexpr double kSpeck_m = 1e-7;  // FCL needs triangles with an area
constexpr double kPrismCornersMost = 512.0;

std::shared_ptr<fcl::CollisionGeometryd> solid_of(const Shape& shape) {
  std::shared_ptr<fcl::CollisionGeometryd> solid;
  if (const auto* box = std::get_if<Box>(&shape)) {
    solid = std::make_shared<fcl::Boxd>(box->size_m);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    solid = std::make_shared<fcl::Cylinderd>(cylinder->radius_m, cylinder->length_m);
  } else {
    solid = std::make_shared<fcl::Sphered>(std::get<Sphere>(shape).radius_m);
  }
  solid->computeLocalAABB();
  return solid;
}

TriangleModel box_surface(const Vector3d& half) {
  TriangleModel model;
  for (int i = 0; i < 8; ++i) {
    model.vertices.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                                i & 4 ? half.z() : -half.z());
  }
  // Each face: its corners in order.
  for (const auto& [a, b, c, d] : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                   {4, 5, 7, 6},
                                   {0, 1, 5, 4},
                                   {2, 6, 7, 3},
                                   {0, 4, 6, 2},
                                   {1, 3, 7, 5}}) {
    model.triangles.push_back({a, b, c});
    model.triangles.push_back({a, c, d});
  }
  return model;
}

TriangleModel prism_surface(const Cylinder& cylinder) {
  const double half_turn = std::numbers::pi;
  const double angle =
      std::acos(cylinder.radius_m / (cylinder.radius_m + AuditedPrimitive::kPrismExcess_m));
  const auto corners =
      static_cast<std::uint32_t>(std::clamp(std::ceil(half_turn / angle), 8.0, kPrismCornersMost));
  const double radius_m = cylinder.radius_m / std::cos(half_turn / corners);
  TriangleModel model;
  model.vertices = {{0, 0, -0.5 * cylinder.length_m}, {0, 0, 0.5 * cylinder.length_m}};
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double turn = 2.0 * half_turn * i / corners;
    const Vector3d p(radius_m * std::cos(turn), radius_m * std::sin(turn), 0);
    for (std::uint32_t end = 0; end < 2; ++end) {
      model.vertices.emplace_back(p + model.vertices[end]);
    }
    const std::uint32_t here = 2 + 2 * i;
    const std::uint32_t next = 2 + 2 * ((i + 1) % corners);
    for (const Triangle& t : {Triangle{0, next, here}, Triangle{1, here + 1, next + 1},
                              Triangle{here, next, next + 1}, Triangle{here, next + 1, here + 1}}) {
      model.triangles.push_back(t);
    }
  }
  return model;
}

}  // namespace

AuditedPrimitive::AuditedPrimitive(const Shape& shape) : shape_(shape), solid_(solid_of(shape)) {}

std::shared_ptr<fcl::CollisionGeometryd> AuditedPrimitive::make_surface() const {
  if (const auto* box = std::get_if<Box>(&shape_)) return box_surface(0.5 * box->size_m).made();
  if (const auto* cylinder = std::get_if<Cylinder>(&shape_)) return prism_surface(*cylinder).made();
  return TriangleModel{
      {Vector3d::Zero(), kSpeck_m * Vector3d::UnitX(), kSpeck_m * Vector3d::UnitY()}, {{0, 1, 2}}}
      .made();
}

double AuditedPrimitive::round_m() const {
  const auto* sphere = std::get_if<Sphere>(&shape_);
  return sphere == nullptr ? 0.0 : sphere->radius_m;
}

double AuditedPrimitive::radius_m() const {
  if (const auto* box = std::get_if<Box>(&shape_)) return 0.5 * box->size_m.norm();
  if (const auto* cylinder = std::get_if<Cylinder>(&shape_)) {
    return std::hypot(cylinder->radius_m, 0.5 * cylinder->length_m);
  }
  return round_m();
}

bool AuditedPrimitive::contains(const Vector3d& p, double within_m) const {
  if (const auto* box = std::get_if<Box>(&shape_)) {
    return ((p.cwiseAbs() - 0.5 * box->size_m).array() <= within_m).all();
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&shape_)) {
    return std::abs(p.z()) - 0.5 * cylinder->length_m <= within_m &&
           std::hypot(p.x(), p.y()) - cylinder->radius_m <= within_m;
  }
  return p.norm() - round_m() <= within_m;
}

double AuditedPrimitive::support(const Vector3d& n) const {
  if (const auto* box = std::get_if<Box>(&shape_)) return 0.5 * n.cwiseAbs().dot(box->size_m);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape_)) {
    return 0.5 * std::abs(n.z()) * cylinder->length_m +
           cylinder->radius_m * std::hypot(n.x(), n.y());
  }
  return round_m();
}

std::optional<double> AuditedPrimitive::proven_distance(const AuditedPrimitive& a,
                                                        const Eigen::Isometry3d& X_WA,
                                                        const AuditedPrimitive& b,
                                                        const Eigen::Isometry3d& X_WB) {
  fcl::DistanceRequestd request(true);
  request.distance_tolerance = kGjkTolerance;
  fcl::DistanceResultd result;
  if (!(fcl::distance<double>(a.solid_.get(), X_WA, b.solid_.get(), X_WB, request, result) > 0.0)) {
    return std::nullopt;
  }
  const Vector3d& on_a = result.nearest_points[0];
  const Vector3d& on_b = result.nearest_points[1];
  const double at_most_m = (on_b - on_a).norm();
  if (!(at_most_m > 0.0) || !a.contains(X_WA.inverse() * on_a, kProof_m) ||
      !b.contains(X_WB.inverse() * on_b, kProof_m)) {
    return std::nullopt;
  }
  const Vector3d n = (on_b - on_a) / at_most_m;
  const double at_least_m = n.dot(X_WB.translation() - X_WA.translation()) -
                            a.support(X_WA.linear().transpose() * n) -
                            b.support(X_WB.linear().transpose() * -n);
  if (at_least_m <= 0.0 || at_most_m - at_least_m > kProof_m) return std::nullopt;
  return at_least_m;
}

}  // namespace armloom

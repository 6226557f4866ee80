#include "core/collision/diagram/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armloom {
namespace {

using Eigen::Vector3d;

// Bound of some ten roundings of coordinates of a few meters.
constexpr double kRounding_m = 1e-13;

}  // namespace

Sweep::Sweep(std::span<const MovingAxis> axes, const Vector3d& n_W) : axes_(axes), n_(n_W) {
  moments_.reserve(axes.size());
  for (const MovingAxis& axis : axes) {
    if (axis.prismatic) {
      shifts_m_ += axis.loose * std::abs(n_.dot(axis.z_W));
      drift_.offset -= axis.drift * n_.dot(axis.z_W);
      continue;
    }
    const Vector3d across = n_.cross(axis.z_W);
    const double offset = across.dot(axis.p_WO);
    moments_.push_back({axis.loose * across, axis.loose * offset});
    drift_.m += axis.drift * across;
    drift_.offset += axis.drift * offset;
    turn_ += axis.span() * across.norm();
  }
}

// Returns n . p plus the first sum (class comment).
double Sweep::at(const Vector3d& p_W) const { return n_.dot(p_W) + added(p_W); }

double Sweep::added(const Vector3d& p_W) const {
  double sum = shifts_m_ + std::abs(drift_.m.dot(p_W) - drift_.offset);
  for (const Moment& moment : moments_) sum += std::abs(moment.m.dot(p_W) - moment.offset);
  return sum;
}

// Returns how much larger at() may be within a ball than at its center. at() is the largest of
// several linear functions with slopes n + sum of +-m. All m are normal to n, so no slope exceeds
// hypot(1, turn_).
double Sweep::round(double radius_m) const { return radius_m * std::hypot(1.0, turn_); }

// Returns the second sum (class comment) for points within radius_m of the center.
double Sweep::remainder(const Vector3d& center_W, double radius_m) const {
  double sum = 0.0;
  double turned = 0.0;  // sum of the spans of the previous axes that turn
  for (const MovingAxis& axis : axes_) {
    if (axis.prismatic) {
      sum += axis.span() * turned;
      continue;
    }
    const double lever_m = axis.z_W.cross(center_W - axis.p_WO).norm() + radius_m;
    sum += axis.span() * lever_m * (0.5 * axis.span() + turned);
    turned += axis.span();
  }
  return sum + kRounding_m;
}

// Bounds at() over both flat ends. Like round(), but only the part of the slope within the plane of
// the disc matters.
double Sweep::of_cylinder(const ConvexShape& shape, const PlacedConvexShape& placed) const {
  const Vector3d along = placed.X_WS.linear().col(2);
  const Vector3d across = n_ - n_.dot(along) * along;
  double squared = across.squaredNorm() + turn_ * turn_ + 2.0 * std::abs(across.dot(drift_.m));
  for (const Moment& moment : moments_) squared += 2.0 * std::abs(across.dot(moment.m));
  const Vector3d& center = placed.segment.center;
  return std::max(at(center + placed.segment.half), at(center - placed.segment.half)) +
         shape.radius_m * std::sqrt(squared);
}

double Sweep::of_box(const ConvexShape& shape, const PlacedConvexShape& placed) const {
  double largest = -std::numeric_limits<double>::infinity();
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vector3d p = shape.half_size_m;
    for (unsigned k = 0; k < 3; ++k) {
      if ((corner >> k & 1U) != 0) p[k] = -p[k];
    }
    largest = std::max(largest, at(placed.X_WS * p));
  }
  return largest;
}

double Sweep::of_hull(const ConvexShape& shape, const PlacedConvexShape& placed) const {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& p : shape.hull->hull.vertices) {
    largest = std::max(largest, at(placed.X_WS * p));
  }
  return largest;
}

double Sweep::reach(const ConvexShape& shape, const PlacedConvexShape& placed) const {
  const Vector3d& center = placed.segment.center;
  const double rest = remainder(center, shape.bounding_radius_m());
  switch (shape.kind) {
    case ConvexShapeKind::box:
      return of_box(shape, placed) + rest;
    case ConvexShapeKind::cylinder:
      return of_cylinder(shape, placed) + rest;
    case ConvexShapeKind::hull:
      return of_hull(shape, placed) + rest;
    case ConvexShapeKind::round:
      break;
  }
  return std::max(at(center + placed.segment.half), at(center - placed.segment.half)) +
         round(shape.radius_m) + rest;
}

double Sweep::reach(std::span<const Vector3d> p_W, double radius_m) const {
  double largest = -std::numeric_limits<double>::infinity();
  double size_m = 0.0;
  for (const Vector3d& p : p_W) {
    largest = std::max(largest, at(p));
    size_m = std::max(size_m, (p - p_W.front()).norm());
  }
  return largest + round(radius_m) + remainder(p_W.front(), size_m + radius_m);
}

double Sweep::overestimate(std::span<const Vector3d> p_W, double radius_m) const {
  Vector3d center_W = Vector3d::Zero();
  for (const Vector3d& p : p_W) center_W += p / static_cast<double>(p_W.size());
  double largest = 0.0;
  double size_m = 0.0;
  for (const Vector3d& p : p_W) {
    largest = std::max(largest, added(p));
    size_m = std::max(size_m, (p - center_W).norm());
  }
  return largest + round(radius_m) + remainder(center_W, size_m + radius_m);
}

}  // namespace armloom

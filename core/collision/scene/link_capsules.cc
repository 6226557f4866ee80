#include "core/collision/scene/link_capsules.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/geometry/spread_directions.h"

namespace armloom {
namespace {

using Balls = std::vector<Ball>;
using Points = std::vector<Eigen::Vector3d>;

constexpr int kCorners = 64;  // corners of the polygon around a cylinder's end
constexpr std::size_t kAllPartitionsUpTo = 8;
constexpr std::size_t kPartitionsFitted = 3;

LinkCapsule capsule_of(const ConvexShape& round) {
  const Eigen::Vector3d center = round.X_PS.translation();
  return {center - round.p_SE_P, center + round.p_SE_P, round.radius_m};
}

struct Spanned {
  Balls balls;
  Balls outer;  // the outermost balls suffice to compare partitions
  Points axes;
};

Spanned span(const ConvexShape& shape) {
  Spanned spanned{extreme_balls(shape), {}, {}};
  spanned.outer = outermost(spanned.balls);
  if (shape.kind == ConvexShapeKind::round && shape.half_length_m == 0.0) return spanned;
  spanned.axes.emplace_back(shape.X_PS.linear().col(2));
  if (shape.kind == ConvexShapeKind::box) {
    spanned.axes.emplace_back(shape.X_PS.linear().col(0));
    spanned.axes.emplace_back(shape.X_PS.linear().col(1));
  }
  return spanned;
}

// By shape: true if the shape belongs to the first of two capsules.
using Partition = std::vector<bool>;

LinkCapsule fit_group(const std::vector<Spanned>& shapes, const Partition& partition, bool group,
                      bool thorough) {
  Balls balls;
  Points axes;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (partition[i] != group) continue;
    const Balls& of_shape = thorough ? shapes[i].balls : shapes[i].outer;
    balls.insert(balls.end(), of_shape.begin(), of_shape.end());
    if (axes.size() < 6) axes.insert(axes.end(), shapes[i].axes.begin(), shapes[i].axes.end());
  }
  return fit_capsule(balls, axes, thorough);
}

std::vector<Partition> all_partitions(std::size_t count) {
  std::vector<Partition> partitions;
  for (std::size_t mask = 1; mask < (std::size_t{1} << (count - 1)); ++mask) {
    Partition partition(count);
    for (std::size_t i = 0; i < count; ++i) partition[i] = ((mask >> i) & 1U) != 0;
    partitions.push_back(std::move(partition));
  }
  return partitions;
}

// Sorts the shapes along each axis of the body. Returns all splits of each order into its first k
// shapes and the rest.
std::vector<Partition> partitions_along_axes(const std::vector<ConvexShape>& shapes) {
  std::vector<Partition> partitions;
  std::vector<std::size_t> order(shapes.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return shapes[a].X_PS.translation()[axis] < shapes[b].X_PS.translation()[axis];
    });
    Partition partition(shapes.size(), false);
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
      partition[order[k]] = true;
      partitions.push_back(partition);
    }
  }
  return partitions;
}

std::pair<LinkCapsule, LinkCapsule> fit_two(const std::vector<ConvexShape>& shapes,
                                            const std::vector<Spanned>& spanned) {
  const auto partitions = shapes.size() <= kAllPartitionsUpTo ? all_partitions(shapes.size())
                                                              : partitions_along_axes(shapes);
  std::vector<std::pair<double, const Partition*>> rated;
  for (const Partition& partition : partitions) {
    const double volume = fit_group(spanned, partition, true, false).volume_m3() +
                          fit_group(spanned, partition, false, false).volume_m3();
    rated.emplace_back(volume, &partition);
  }
  std::stable_sort(rated.begin(), rated.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::pair<LinkCapsule, LinkCapsule> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(kPartitionsFitted, rated.size()); ++i) {
    const LinkCapsule first = fit_group(spanned, *rated[i].second, true, true);
    const LinkCapsule second = fit_group(spanned, *rated[i].second, false, true);
    const double volume = first.volume_m3() + second.volume_m3();
    if (volume >= least) continue;
    least = volume;
    best = {first, second};
  }
  return best;
}

double distance_from(const ConvexShape& shape, const Eigen::Vector3d& p_P) {
  if (shape.kind == ConvexShapeKind::round) {
    return distance_to_axis(capsule_of(shape), p_P) - shape.radius_m;
  }
  const Eigen::Vector3d p = shape.X_PS.inverse(Eigen::Isometry) * p_P;
  if (shape.kind == ConvexShapeKind::box)
    return (p.cwiseAbs() - shape.half_size_m).cwiseMax(0.0).norm();
  if (shape.kind == ConvexShapeKind::cylinder) {
    return std::hypot(std::max(0.0, std::abs(p.z()) - shape.half_length_m),
                      std::max(0.0, std::hypot(p.x(), p.y()) - shape.radius_m));
  }
  return distance_to_surface(*shape.solid->tree, shape.solid->X_PT.inverse(Eigen::Isometry) * p_P);
}

// Returns points on the capsule's surface: rings along its side, and its two caps.
Points surface_points(const LinkCapsule& capsule) {
  static const Points kDirections = spread_directions(96);
  const Eigen::Vector3d along = capsule.p_PB - capsule.p_PA;
  Points points;
  for (const Eigen::Vector3d& n : kDirections) {
    points.push_back((along.dot(n) > 0.0 ? capsule.p_PB : capsule.p_PA) + capsule.radius_m * n);
  }
  if (along.norm() == 0.0) return points;
  const Eigen::Vector3d u = along.unitOrthogonal();
  const Eigen::Vector3d v = along.normalized().cross(u);
  constexpr int kRings = 7;
  constexpr int kAround = 16;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      points.push_back(capsule.p_PA + ring / (kRings - 1.0) * along +
                       capsule.radius_m * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  return points;
}

double overestimate_of(const std::vector<LinkCapsule>& capsules,
                       const std::vector<ConvexShape>& shapes) {
  double overestimate = 0.0;
  for (const LinkCapsule& capsule : capsules) {
    for (const Eigen::Vector3d& p : surface_points(capsule)) {
      const bool hidden = std::any_of(capsules.begin(), capsules.end(), [&](const auto& other) {
        return &other != &capsule && distance_to_axis(other, p) < other.radius_m;
      });
      if (hidden) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const ConvexShape& shape : shapes) {
        nearest = std::min(nearest, distance_from(shape, p));
        if (nearest <= overestimate) break;
      }
      overestimate = std::max(overestimate, nearest);
    }
  }
  return overestimate;
}

double volume_of(const std::vector<LinkCapsule>& capsules) {
  double volume = 0.0;
  for (const LinkCapsule& capsule : capsules) volume += capsule.volume_m3();
  return volume;
}

// Returns the capsule of a round shape that contains all others, because no other fit is better;
// nullopt if there is no such shape.
std::optional<LinkCapsule> shape_around_all(const std::vector<ConvexShape>& shapes) {
  for (const ConvexShape& round : shapes) {
    if (round.kind != ConvexShapeKind::round) continue;
    const LinkCapsule capsule = capsule_of(round);
    const bool all = std::all_of(shapes.begin(), shapes.end(), [&](const ConvexShape& shape) {
      return contains(capsule, shape);
    });
    if (all) return capsule;
  }
  return std::nullopt;
}

bool clearly_better(const LinkCapsules& two, const LinkCapsules& one) {
  const double volume = volume_of(two.capsules) / volume_of(one.capsules);
  if (volume < kTwoVolume) return true;
  return volume <= 1.0 && two.overestimate_m < kTwoOverestimate * one.overestimate_m &&
         two.overestimate_m < one.overestimate_m - kTwoGain_m;
}

void check(const LinkCapsules& fitted, const std::vector<ConvexShape>& shapes) {
  for (const ConvexShape& shape : shapes) {
    const bool inside = std::any_of(fitted.capsules.begin(), fitted.capsules.end(),
                                    [&](const auto& capsule) { return contains(capsule, shape); });
    if (!inside) throw std::logic_error("a shape lies in none of its body's capsules");
  }
}

}  // namespace

std::vector<Ball> extreme_balls(const ConvexShape& shape) {
  Balls balls;
  switch (shape.kind) {
    case ConvexShapeKind::round: {
      const LinkCapsule capsule = capsule_of(shape);
      balls.push_back({capsule.p_PA, shape.radius_m});
      if (shape.half_length_m > 0.0) balls.push_back({capsule.p_PB, shape.radius_m});
      break;
    }
    case ConvexShapeKind::box:
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        balls.push_back({shape.X_PS * signs.cwiseProduct(shape.half_size_m), 0.0});
      }
      break;
    case ConvexShapeKind::cylinder:
      for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        const double r = shape.radius_m / std::cos(std::numbers::pi / kCorners);
        for (const double z : {-shape.half_length_m, shape.half_length_m}) {
          const Eigen::Vector3d corner(r * std::cos(angle), r * std::sin(angle), z);
          balls.push_back({shape.X_PS * corner, 0.0});
        }
      }
      break;
    case ConvexShapeKind::hull:
      for (const Eigen::Vector3d& p : shape.hull->hull.vertices) {
        balls.push_back({shape.X_PS * p, 0.0});
      }
      break;
  }
  return balls;
}

bool contains(const LinkCapsule& capsule, const ConvexShape& shape) {
  const Balls balls = extreme_balls(shape);
  return std::all_of(balls.begin(), balls.end(),
                     [&](const Ball& ball) { return contains(capsule, ball); });
}

LinkCapsules fit_capsules(const std::vector<ConvexShape>& shapes) {
  if (shapes.empty()) throw std::invalid_argument("fit_capsules: needs at least one shape");
  if (const auto around = shape_around_all(shapes)) {
    LinkCapsules fitted{{*around}, 0.0};
    fitted.overestimate_m = overestimate_of(fitted.capsules, shapes);
    return fitted;
  }
  std::vector<Spanned> spanned;
  for (const ConvexShape& shape : shapes) spanned.push_back(span(shape));
  const Partition together(shapes.size(), true);
  LinkCapsules fitted{{fit_group(spanned, together, true, true)}, 0.0};
  fitted.overestimate_m = overestimate_of(fitted.capsules, shapes);
  if (shapes.size() > 1) {
    const auto [first, second] = fit_two(shapes, spanned);
    LinkCapsules two{{first, second}, 0.0};
    two.overestimate_m = overestimate_of(two.capsules, shapes);
    if (clearly_better(two, fitted)) fitted = std::move(two);
  }
  check(fitted, shapes);
  return fitted;
}

}  // namespace armloom

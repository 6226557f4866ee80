#include "core/geometry/capsule/capsule_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "core/geometry/spread_directions.h"

namespace armloom {
namespace {

using Balls = std::vector<Ball>;
using Directions = std::vector<Eigen::Vector3d>;

constexpr int kOutermostDirections = 60;

// The variables of the search: the line of the capsule's axis, and extra width, because a wider
// capsule may be shorter.
struct Axis {
  Eigen::Vector3d point;
  Eigen::Vector3d direction;  // unit
  double widening = 0.0;
};

LinkCapsule capsule_about(const Axis& axis, const Balls& balls) {
  double radius = 0.0;
  for (const Ball& ball : balls) {
    const Eigen::Vector3d d = ball.center - axis.point;
    const double t = d.dot(axis.direction);
    radius = std::max(radius, std::sqrt(std::max(0.0, d.squaredNorm() - t * t)) + ball.radius_m);
  }
  radius *= 1.0 + axis.widening;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Ball& ball : balls) {
    const Eigen::Vector3d d = ball.center - axis.point;
    const double t = d.dot(axis.direction);
    const double room = radius - ball.radius_m;
    const double along = std::sqrt(std::max(0.0, room * room - (d.squaredNorm() - t * t)));
    low = std::min(low, t + along);
    high = std::max(high, t - along);
  }
  if (low > high) {  // no axis is needed: a single ball contains all balls
    low = high = 0.5 * (low + high);
    const Eigen::Vector3d center = axis.point + low * axis.direction;
    radius = 0.0;
    for (const Ball& ball : balls) {
      radius = std::max(radius, (ball.center - center).norm() + ball.radius_m);
    }
  }
  return {axis.point + low * axis.direction, axis.point + high * axis.direction, radius};
}

double extent_of(const Balls& balls) {
  double extent = 0.0;
  for (const Ball& ball : balls) {
    extent = std::max(extent, (ball.center - balls.front().center).norm() + ball.radius_m);
  }
  return extent;
}

// Returns two perpendicular unit vectors across `direction`.
std::array<Eigen::Vector3d, 2> across(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d first = direction.unitOrthogonal();
  return {first, direction.cross(first)};
}

// Returns the line along the direction through the middle of the balls.
Axis axis_along(const Eigen::Vector3d& direction, const Balls& balls) {
  const auto sides = across(direction);
  Axis axis{Eigen::Vector3d::Zero(), direction};
  for (const Eigen::Vector3d& side : sides) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Ball& ball : balls) {
      low = std::min(low, side.dot(ball.center) - ball.radius_m);
      high = std::max(high, side.dot(ball.center) + ball.radius_m);
    }
    axis.point += 0.5 * (low + high) * side;
  }
  return axis;
}

void add_principal_axes(const Balls& balls, Directions& directions) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Ball& ball : balls) mean += ball.center / static_cast<double>(balls.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Ball& ball : balls) {
    covariance += (ball.center - mean) * (ball.center - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  for (int i = 0; i < 3; ++i) directions.emplace_back(solver.eigenvectors().col(i));
}

struct Candidate {
  Axis axis;
  double volume_m3;
};

Candidate rated(const Axis& axis, const Balls& balls) {
  return {axis, capsule_about(axis, balls).volume_m3()};
}

using Step = Eigen::Matrix<double, 5, 1>;  // rotation (rad), shift (share of the extent), widening

Axis moved(const Axis& axis, const Step& step, double extent) {
  const auto sides = across(axis.direction);
  Axis next;
  next.direction = (axis.direction + step[0] * sides[0] + step[1] * sides[1]).normalized();
  next.point = axis.point + extent * (step[2] * sides[0] + step[3] * sides[1]);
  next.widening = std::max(0.0, axis.widening + step[4]);
  return next;
}

// Improves a candidate by a pattern search. It tries steps of each variable alone and, because the
// volume is not a smooth function, steps in random directions.
Candidate improved(Candidate best, const Balls& balls, double extent) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Ball& ball : balls) center += ball.center / static_cast<double>(balls.size());
  for (double size = 0.2; size > 2e-4; size *= 0.5) {
    for (int round = 0; round < 4; ++round) {
      const double before = best.volume_m3;
      for (int i = 0; i < 11; ++i) {
        Step step = Step::Zero();
        if (i < 5) {
          step[i] = size;
        } else {
          for (double& value : step) value = normal(random);
          step *= size / step.norm();
        }
        // Rotations are about the balls' center.
        best.axis.point += best.axis.direction.dot(center - best.axis.point) * best.axis.direction;
        for (const double sign : {1.0, -1.0}) {
          const Candidate next = rated(moved(best.axis, sign * step, extent), balls);
          if (next.volume_m3 >= best.volume_m3) continue;
          best = next;
          break;
        }
      }
      if (best.volume_m3 > before * (1.0 - 1e-4)) break;
    }
  }
  return best;
}

// Corrects the radius for rounding and verifies that the capsule contains every ball.
LinkCapsule checked(LinkCapsule capsule, const Balls& balls) {
  double reach = 0.0;
  capsule.radius_m = 0.0;
  for (const Ball& ball : balls) {
    reach = std::max(reach, ball.center.norm() + ball.radius_m);
    capsule.radius_m =
        std::max(capsule.radius_m, distance_to_axis(capsule, ball.center) + ball.radius_m);
  }
  capsule.radius_m += 1e-12 * (capsule.radius_m + reach);
  for (const Ball& ball : balls) {
    if (!contains(capsule, ball)) throw std::logic_error("a capsule does not contain its shape");
  }
  return capsule;
}

}  // namespace

double LinkCapsule::volume_m3() const {
  return std::numbers::pi * radius_m * radius_m * ((p_PB - p_PA).norm() + 4.0 / 3.0 * radius_m);
}

double distance_to_axis(const LinkCapsule& capsule, const Eigen::Vector3d& p) {
  const Eigen::Vector3d along = capsule.p_PB - capsule.p_PA;
  const double t = along.dot(p - capsule.p_PA);
  if (t <= 0.0) return (p - capsule.p_PA).norm();
  const double length_squared = along.squaredNorm();
  if (t >= length_squared) return (p - capsule.p_PB).norm();
  return (p - capsule.p_PA - t / length_squared * along).norm();
}

bool contains(const LinkCapsule& capsule, const Ball& ball) {
  const double distance = distance_to_axis(capsule, ball.center);
  if (distance == 0.0) return ball.radius_m <= capsule.radius_m;
  const double size = ball.center.norm() + capsule.p_PA.norm() + capsule.p_PB.norm();
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * size;
  return distance + ball.radius_m + rounding <= capsule.radius_m;
}

std::vector<Ball> outermost(const std::vector<Ball>& balls) {
  if (balls.size() <= kOutermostDirections) return balls;
  static const Directions kDirections = spread_directions(kOutermostDirections);
  std::vector<std::size_t> chosen;
  for (const Eigen::Vector3d& n : kDirections) {
    std::size_t farthest = 0;
    double reach = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const double r = n.dot(balls[i].center) + balls[i].radius_m;
      if (r <= reach) continue;
      reach = r;
      farthest = i;
    }
    chosen.push_back(farthest);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  Balls outer;
  for (const std::size_t i : chosen) outer.push_back(balls[i]);
  return outer;
}

LinkCapsule fit_capsule(const std::vector<Ball>& balls,
                        const std::vector<Eigen::Vector3d>& directions, bool thorough) {
  const Balls outer = outermost(balls);
  Directions starts = directions;
  add_principal_axes(outer, starts);
  std::vector<Candidate> candidates;
  for (const Eigen::Vector3d& direction : starts) {
    candidates.push_back(rated(axis_along(direction, outer), outer));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.volume_m3 < b.volume_m3; });
  Candidate best = candidates.front();
  if (thorough) {
    const double extent = extent_of(outer);
    for (std::size_t i = 0; i < std::min<std::size_t>(2, candidates.size()); ++i) {
      const Candidate next = improved(candidates[i], outer, extent);
      if (next.volume_m3 < best.volume_m3) best = next;
    }
  }
  return checked(capsule_about(best.axis, balls), balls);
}

}  // namespace armloom

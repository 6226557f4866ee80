#include "core/geometry/surface/inner_balls.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "core/geometry/surface/enclosure.h"
#include "core/geometry/surface/surface_descent.h"

namespace armloom {

using Eigen::Array4f;
using Eigen::Vector3d;

InnerBalls::InnerBalls(const std::vector<Ball>& balls) {
  constexpr float kNone_m = -1e18F;
  const Array4f zero = Array4f::Zero();
  fours_.assign((balls.size() + 3) / 4, {zero, zero, zero, zero + kNone_m});
  for (std::size_t i = 0; i < balls.size(); ++i) {
    Four& four = fours_[i / 4];
    const auto k = static_cast<Eigen::Index>(i % 4);
    const Eigen::Vector3f p = balls[i].center.cast<float>();
    four.x[k] = p.x();
    four.y[k] = p.y();
    four.z[k] = p.z();
    four.radius_m[k] = static_cast<float>(balls[i].radius_m);
    reach_m_ = std::max(reach_m_, balls[i].center.norm() + balls[i].radius_m);
  }
}

bool InnerBalls::surely_meet(const InnerBalls& others, const Eigen::Isometry3d& X,
                             double limit_m) const {
  const Eigen::Matrix3f R = X.linear().cast<float>();
  const Eigen::Vector3f p = X.translation().cast<float>();
  // Covers about twenty roundings of numbers that are at most the sum in parentheses.
  const double slack_m = 64.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                         (reach_m_ + others.reach_m_ + X.translation().norm());
  const auto more_m = static_cast<float>(limit_m - slack_m);
  for (const Four& other : others.fours_) {
    const Array4f x = R(0, 0) * other.x + R(0, 1) * other.y + R(0, 2) * other.z + p.x();
    const Array4f y = R(1, 0) * other.x + R(1, 1) * other.y + R(1, 2) * other.z + p.y();
    const Array4f z = R(2, 0) * other.x + R(2, 1) * other.y + R(2, 2) * other.z + p.z();
    const Array4f reach_m = other.radius_m + more_m;
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (const Four& own : fours_) {
        const Array4f squared =
            (own.x - x[i]).square() + (own.y - y[i]).square() + (own.z - z[i]).square();
        if ((squared < (own.radius_m + reach_m[i]).max(0.0F).square()).any()) return true;
      }
    }
  }
  return false;
}

std::vector<Ball> inner_balls(const Vector3d& center, const Vector3d& half_m,
                              const Depth& depth_m) {
  constexpr int kAlong = 8;  // points tried along each side of the box
  std::vector<Ball> tried;
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const Vector3d at(i % kAlong, i / kAlong % kAlong, i / kAlong / kAlong);
    const Vector3d p =
        center + ((2.0 * at.array() + 1.0) / kAlong - 1.0).matrix().cwiseProduct(half_m);
    if (const double radius_m = depth_m(p); radius_m > 0.0) tried.push_back({p, radius_m});
  }
  std::ranges::stable_sort(tried, std::ranges::greater{}, &Ball::radius_m);
  std::vector<Ball> chosen;
  for (const Ball& ball : tried) {
    const bool covered = std::ranges::any_of(chosen, [&](const Ball& other) {
      return (other.center - ball.center).norm() < 0.7 * other.radius_m;
    });
    if (!covered && chosen.size() < kInnerBalls) chosen.push_back(ball);
  }
  return chosen;
}

std::vector<Ball> inner_balls(const SurfaceTree& tree) {
  if (!tree.encloses) return {};
  return inner_balls(
      tree.root.center.cast<double>(), tree.root.half.cast<double>(),
      [&](const Vector3d& p) { return may_enclose(tree, p) ? distance_to_surface(tree, p) : 0.0; });
}

}  // namespace armloom

#include "core/geometry/surface/surface_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armloom {
namespace {

using Eigen::Array4f;
using Eigen::Vector3d;

float size(const SurfaceTree::Box& box) { return box.half.maxCoeff(); }

}  // namespace

SurfaceDescent::SurfaceDescent(const SurfaceTree& a, const SurfaceTree& b,
                               const Eigen::Isometry3d& X_AB, double limit_m, double enough_m)
    : a_(a),
      b_(b),
      X_AB_(X_AB),
      of_b_in_a_(turn_of(X_AB)),
      of_a_in_b_(turn_of(X_AB.inverse(Eigen::Isometry))),
      best_m_(limit_m),
      enough_m_(enough_m),
      kept_{nullptr, std::numeric_limits<double>::infinity()} {
  // Covers about thirty roundings for boxes, and ten for triangles, of numbers that are at most
  // `most_m`.
  const double most_m = a.reach_m + b.reach_m + X_AB.translation().norm();
  rounding_.boxes_m = 64.0F * std::numeric_limits<float>::epsilon() * static_cast<float>(most_m);
  rounding_.triangles_m = 64.0 * std::numeric_limits<double>::epsilon() * most_m;
}

SurfaceDescent::Turn SurfaceDescent::turn_of(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3f R = X.linear().cast<float>();
  return {R, R.cwiseAbs(), X.translation().cast<float>()};
}

void SurfaceDescent::part_along(const Vector3d& n_A) {
  n_A_ = n_A;
  n_B_ = X_AB_.linear().transpose() * n_A;
  n_offset_m_ = n_A.dot(X_AB_.translation());
  const Eigen::Vector3f in_a = n_A.cast<float>();
  const Eigen::Vector3f in_b = n_B_.cast<float>();
  of_b_in_a_.n_S = in_a;
  of_a_in_b_.n_S = -in_b;
  of_b_in_a_.n_width_S = of_a_in_b_.n_width_X = in_a.cwiseAbs();
  of_a_in_b_.n_width_S = of_b_in_a_.n_width_X = in_b.cwiseAbs();
  if (kept_.apart != nullptr)
    kept_.along_m = kept_.apart->enough_along(n_A) + rounding_.triangles_m;
}

double SurfaceDescent::run() {
  const Vector3d apart = X_AB_ * b_.root.center.cast<double>() - a_.root.center.cast<double>();
  if (apart.squaredNorm() > 0.0) part_along(apart.normalized());
  Node root;
  root.center = {Array4f::Constant(b_.root.center[0]), Array4f::Constant(b_.root.center[1]),
                 Array4f::Constant(b_.root.center[2])};
  root.half = {Array4f::Constant(b_.root.half[0]), Array4f::Constant(b_.root.half[1]),
               Array4f::Constant(b_.root.half[2])};
  roots_m_ = static_cast<double>(gaps(a_.root, root, of_b_in_a_).least_m[0]);
  if (roots_m_ >= best_m_) return best_m_;
  if (a_.root.leaf && b_.root.leaf) {
    measure(a_.root.below, b_.root.below);
  } else {
    visit(a_.root, b_.root);
  }
  return std::min(best_m_, passed_m_);
}

// Returns lower bounds of the gaps between `box` and the four boxes of `others`, from the axes of
// both frames and the latest separating direction.
SurfaceDescent::Gaps SurfaceDescent::gaps(const Box& box, const Node& others,
                                          const Turn& turn) const {
  const Eigen::Vector3f from = turn.p - box.center;
  const Eigen::Vector3f reach = turn.width.transpose() * box.half;
  std::array<Array4f, 3> apart;  // in the frame of the box
  Array4f along = Array4f::Constant(-turn.n_width_S.dot(box.half));
  Array4f squared = Array4f::Zero();
  Array4f across = Array4f::Constant(-std::numeric_limits<float>::infinity());
  for (int i = 0; i < 3; ++i) {
    apart[i] = turn.R(i, 0) * others.center[0] + turn.R(i, 1) * others.center[1] +
               turn.R(i, 2) * others.center[2] + from[i];
    const Array4f gap = apart[i].abs() - box.half[i] - turn.width(i, 0) * others.half[0] -
                        turn.width(i, 1) * others.half[1] - turn.width(i, 2) * others.half[2];
    across = across.max(gap);
    squared += gap.max(0.0F).square();
    along += turn.n_S[i] * apart[i] - turn.n_width_X[i] * others.half[i];
  }
  Array4f squared_other = Array4f::Zero();
  for (int i = 0; i < 3; ++i) {
    const Array4f gap =
        (turn.R(0, i) * apart[0] + turn.R(1, i) * apart[1] + turn.R(2, i) * apart[2]).abs() -
        reach[i] - others.half[i];
    across = across.max(gap);
    squared_other += gap.max(0.0F).square();
  }
  const Array4f least = squared.max(squared_other).sqrt().max(along);
  return {least - rounding_.boxes_m, along - rounding_.boxes_m,
          (across > 0.0F).select(least, across)};
}

// Opens the larger box, or the only box that is not a leaf. Precondition: the boxes are not both
// leaves.
void SurfaceDescent::visit(const Box& a, const Box& b) {
  const bool into_a = b.leaf || (!a.leaf && size(a) >= size(b));
  const Node& opened = into_a ? a_.nodes[a.below] : b_.nodes[b.below];
  const Gaps found = into_a ? gaps(b, opened, of_a_in_b_) : gaps(a, opened, of_b_in_a_);
  std::array<int, 4> next{0, 1, 2, 3};
  const auto before = [&](int i, int j) {
    if (found.order[next[j]] < found.order[next[i]]) std::swap(next[i], next[j]);
  };
  before(0, 1);
  before(2, 3);
  before(0, 2);
  before(1, 3);
  before(1, 2);
  const Box& other = into_a ? b : a;
  for (const int i : next) {
    if (best_m_ < enough_m_) return;
    if (static_cast<double>(found.least_m[i]) >= passes_at()) {
      passed_m_ = std::min(passed_m_, static_cast<double>(found.least_m[i]));
      continue;
    }
    if (static_cast<double>(found.along_m[i]) >= kept_.along_m) continue;
    const auto k = static_cast<std::size_t>(i);
    if (other.leaf && opened.leaf[k]) {
      into_a ? measure(opened.below[k], b.below) : measure(a.below, opened.below[k]);
      continue;
    }
    const Box box = opened.box(k);
    into_a ? visit(box, b) : visit(a, box);
  }
}

void SurfaceDescent::measure(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t both = ((std::uint64_t{a} << 32U) | b) + 1;
  std::uint64_t& last = measured_[(a * 31U + b) % measured_.size()];
  if (last == both) return;
  last = both;
  const double limit_m = best_m_ + rounding_.triangles_m;
  const TrianglePoints own = a_.corners(a);
  TrianglePoints other = b_.corners(b);
  const double along = n_offset_m_ +
                       std::min({n_B_.dot(other[0]), n_B_.dot(other[1]), n_B_.dot(other[2])}) -
                       std::max({n_A_.dot(own[0]), n_A_.dot(own[1]), n_A_.dot(own[2])});
  if (along >= kept_.along_m) return;
  if (along >= passes_at() + rounding_.triangles_m) {
    passed_m_ = std::min(passed_m_, along - rounding_.triangles_m);
    return;
  }
  for (Vector3d& p : other) p = X_AB_ * p;
  const TriangleGap found = triangle_gap(own, other, limit_m);
  if (found.distance_m >= limit_m) return;
  if (kept_.apart != nullptr && found.distance_m > 0.0 && kept_.apart->keeps(own, other, found.n)) {
    part_along(found.n);
    return;
  }
  best_m_ = found.distance_m - rounding_.triangles_m;
  if (found.distance_m > 0.0) part_along(found.n);
}

double distance_to_surface(const SurfaceTree& tree, const Vector3d& p_T) {
  static const SurfaceTreePtr kPoint = make_surface_tree({Vector3d::Zero()}, {{0, 0, 0}});
  Eigen::Isometry3d X_TP = Eigen::Isometry3d::Identity();
  X_TP.translation() = p_T;
  constexpr double kNone_m = std::numeric_limits<double>::infinity();
  return SurfaceDescent(tree, *kPoint, X_TP, kNone_m, 0.0).run();
}

}  // namespace armloom

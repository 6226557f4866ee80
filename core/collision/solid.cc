#include "core/collision/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/collision/enclosure.h"
#include "core/collision/triangle_distance.h"

namespace armloom {
namespace {

using Eigen::Vector3d;
using Node = SurfaceTree::Node;

Vector3d vector_of(const std::array<float, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

// One question: both trees from the root down, the nearer of two boxes first. All rotations between
// boxes of A and boxes of B are the same one, as boxes lie along the axes of their tree.
class Descent {
 public:
  // Ends as soon as something is found to be closer than enough_m. Distances are without radii.
  Descent(const SurfaceTree& a, const SurfaceTree& b, const Eigen::Isometry3d& X_AB, double limit_m,
          double enough_m)
      : a_(a),
        b_(b),
        R_(X_AB.linear()),
        width_(R_.cwiseAbs()),
        p_(X_AB.translation()),
        // Of some ten roundings of numbers not larger than this.
        rounding_m_(64.0 * std::numeric_limits<double>::epsilon() *
                    (a.reach_m + b.reach_m + p_.norm())),
        best_m_(limit_m),
        enough_m_(enough_m) {}

  // Leaves pairs of triangles (in A's frame) that pass out of account.
  void pass_over(const TrianglesKept* kept) { kept_ = kept; }
  // Nullopt: nothing is closer than the limit.
  std::optional<double> run() {
    const Node& a = a_.nodes.front();
    const Node& b = b_.nodes.front();
    const double limit_m = best_m_;
    roots_m_ = gap(a, b).least_m;
    if (roots_m_ < best_m_) visit(a, b);
    return best_m_ < limit_m ? std::optional(best_m_) : std::nullopt;
  }
  // Whether the boxes around all of A and all of B keep apart.
  [[nodiscard]] bool boxes_apart() const { return roots_m_ > 0.0; }

 private:
  struct Gap {
    double least_m;  // no distance is below it
    double order;    // what to look at first: of boxes that overlap, those that do so deeply
  };

  // At most the distance of what is in the boxes: that of B's box from the box along A's axes that
  // holds A's, and the other way around.
  [[nodiscard]] Gap gap(const Node& a, const Node& b) const {
    const Vector3d half_a = vector_of(a.half);
    const Vector3d half_b = vector_of(b.half);
    const Vector3d apart = R_ * vector_of(b.center) + p_ - vector_of(a.center);
    const Vector3d in_a = apart.cwiseAbs() - half_a - width_ * half_b;
    const Vector3d in_b =
        (R_.transpose() * apart).cwiseAbs() - half_b - width_.transpose() * half_a;
    const double across = std::max(in_a.maxCoeff(), in_b.maxCoeff());
    if (across <= 0.0) return {-rounding_m_, across};
    const double least_m =
        std::sqrt(std::max(in_a.cwiseMax(0.0).squaredNorm(), in_b.cwiseMax(0.0).squaredNorm()));
    return {least_m - rounding_m_, least_m};
  }

  void visit(const Node& a, const Node& b) {
    if (a.leaf && b.leaf) {
      measure(a.first, b.first);
      return;
    }
    const bool into_a = b.leaf || (!a.leaf && size(a) >= size(b));
    const Node* children = into_a ? &a_.nodes[a.first] : &b_.nodes[b.first];
    const Gap gaps[] = {into_a ? gap(children[0], b) : gap(a, children[0]),
                        into_a ? gap(children[1], b) : gap(a, children[1])};
    const int nearer = gaps[1].order < gaps[0].order ? 1 : 0;
    for (const int child : {nearer, 1 - nearer}) {
      if (gaps[child].least_m >= best_m_ || best_m_ < enough_m_) continue;
      into_a ? visit(children[child], b) : visit(a, children[child]);
    }
  }

  static float size(const Node& node) {
    return std::max({node.half[0], node.half[1], node.half[2]});
  }

  void measure(std::uint32_t a, std::uint32_t b) {
    TrianglePoints other = b_.corners(b);
    for (Vector3d& p : other) p = R_ * p + p_;
    const double limit_m = best_m_ + rounding_m_;
    const TrianglePoints own = a_.corners(a);
    const TriangleGap found = triangle_gap(own, other, limit_m);
    if (found.distance_m >= limit_m) return;
    if (kept_ != nullptr && found.distance_m > 0.0 && (*kept_)(own, other, found.n)) return;
    best_m_ = found.distance_m - rounding_m_;
  }

  const SurfaceTree& a_;
  const SurfaceTree& b_;
  Eigen::Matrix3d R_;
  Eigen::Matrix3d width_;
  Vector3d p_;
  double rounding_m_;
  double best_m_;
  double enough_m_;
  double roots_m_ = 0.0;
  const TrianglesKept* kept_ = nullptr;
};

// Surfaces that do not touch: whether a component of one is inside of the other.
bool lies_inside(const SurfaceTree& inner, const SurfaceTree& outer,
                 const Eigen::Isometry3d& X_OI) {
  if (!outer.encloses) return false;
  const Vector3d center = vector_of(outer.nodes.front().center);
  const Vector3d half = vector_of(outer.nodes.front().half);
  return std::any_of(inner.components.begin(), inner.components.end(), [&](const auto& component) {
    const Vector3d p = X_OI * inner.vertices[component.vertex];
    if (((p - center).cwiseAbs().array() > half.array()).any()) return false;
    return may_enclose(outer, p);
  });
}

// Whether balls of both come closer than enough_m, or overlap.
bool balls_meet(const Solid& a, const Solid& b, const Eigen::Isometry3d& X_AB, double enough_m) {
  for (const Solid::InnerBall& ball_b : b.inner) {
    const Vector3d p_A = X_AB * ball_b.p_T;
    for (const Solid::InnerBall& ball_a : a.inner) {
      const double reach_m = ball_a.radius_m + ball_b.radius_m + enough_m;
      if ((ball_a.p_T - p_A).squaredNorm() < reach_m * reach_m) return true;
    }
  }
  return false;
}

double distance(const Solid& a, const Eigen::Isometry3d& X_WA, const Solid& b,
                const Eigen::Isometry3d& X_WB, double limit_m, double enough_m,
                const TrianglesKept* kept = nullptr) {
  const double radii_m = a.radius_m + b.radius_m;
  if (limit_m + radii_m <= 0.0) return limit_m;
  const Eigen::Isometry3d X_AB = X_WA.inverse(Eigen::Isometry) * X_WB;
  if (balls_meet(a, b, X_AB, kept == nullptr ? enough_m : 0.0)) return std::min(limit_m, 0.0);
  Descent descent(*a.tree, *b.tree, X_AB, limit_m + radii_m, enough_m + radii_m);
  descent.pass_over(kept);
  const std::optional<double> closest_m = descent.run();
  const double found_m = closest_m ? std::min(*closest_m - radii_m, limit_m) : limit_m;
  if (found_m <= 0.0) return std::min(limit_m, 0.0);
  if (found_m < enough_m || descent.boxes_apart()) return found_m;
  const bool inside = lies_inside(*a.tree, *b.tree, X_AB.inverse(Eigen::Isometry)) ||
                      lies_inside(*b.tree, *a.tree, X_AB);
  return inside ? std::min(limit_m, 0.0) : found_m;
}

}  // namespace

double solid_distance(const Solid& a, const Eigen::Isometry3d& X_WA, const Solid& b,
                      const Eigen::Isometry3d& X_WB, double limit_m) {
  return distance(a, X_WA, b, X_WB, limit_m, 0.0);
}

bool closer_than(const Solid& a, const Eigen::Isometry3d& X_WA, const Solid& b,
                 const Eigen::Isometry3d& X_WB, double limit_m) {
  return distance(a, X_WA, b, X_WB, limit_m, limit_m) < limit_m;
}

std::vector<Solid::InnerBall> inner_balls(const SurfaceTree& tree) {
  constexpr int kAlong = 8;  // points tried along each side of the box around the surface
  std::vector<Solid::InnerBall> tried;
  const Node& box = tree.nodes.front();
  for (int i = 0; tree.encloses && i < kAlong * kAlong * kAlong; ++i) {
    const Vector3d at(i % kAlong, i / kAlong % kAlong, i / kAlong / kAlong);
    const Vector3d p =
        vector_of(box.center) +
        ((2.0 * at.array() + 1.0) / kAlong - 1.0).matrix().cwiseProduct(vector_of(box.half));
    if (may_enclose(tree, p)) tried.push_back({p, distance_to_surface(tree, p)});
  }
  std::stable_sort(tried.begin(), tried.end(),
                   [](const auto& a, const auto& b) { return a.radius_m > b.radius_m; });
  std::vector<Solid::InnerBall> chosen;
  for (const Solid::InnerBall& ball : tried) {
    const bool covered = std::ranges::any_of(chosen, [&](const Solid::InnerBall& other) {
      return (other.p_T - ball.p_T).norm() < 0.7 * other.radius_m;
    });
    if (!covered && chosen.size() < kInnerBalls) chosen.push_back(ball);
  }
  return chosen;
}

bool all_apart(const Solid& a, const Eigen::Isometry3d& X_WA, const Solid& b,
               const Eigen::Isometry3d& X_WB, double within_m, const TrianglesKept& kept) {
  const TrianglesKept kept_in_a = [&](TrianglePoints at_a, TrianglePoints at_b,
                                      const Vector3d& n_A) {
    for (Vector3d& p : at_a) p = X_WA * p;
    for (Vector3d& p : at_b) p = X_WA * p;
    return kept(at_a, at_b, X_WA.linear() * n_A);
  };
  return distance(a, X_WA, b, X_WB, within_m, within_m, &kept_in_a) >= within_m;
}

double distance_to_surface(const SurfaceTree& tree, const Eigen::Vector3d& p_T) {
  static const SurfaceTreePtr kPoint = make_surface_tree({Vector3d::Zero()}, {{0, 0, 0}});
  Eigen::Isometry3d X_TP = Eigen::Isometry3d::Identity();
  X_TP.translation() = p_T;
  return Descent(tree, *kPoint, X_TP, std::numeric_limits<double>::infinity(), 0.0).run().value();
}

}  // namespace armloom

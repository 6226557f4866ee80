#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/geometry/mesh/surface_tree.h"
#include "core/geometry/surface/triangle_distance.h"

namespace armloom {

// Predicate for triangle pairs that may be skipped although closer than the query distance. In the
// frame of A's tree; directions of unit length, from A to B.
class KeptApart {
 public:
  virtual ~KeptApart() = default;
  // Returns true if two triangles may be skipped; n separates them (TriangleGap).
  [[nodiscard]] virtual bool keeps(const TrianglePoints& a, const TrianglePoints& b,
                                   const Eigen::Vector3d& n) = 0;
  // Returns the separation along n beyond which everything can be skipped.
  [[nodiscard]] virtual double enough_along(const Eigen::Vector3d& n) const = 0;
};

// Distances from exact_below_m on may be returned up to by_m too small.
struct Roughness {
  double exact_below_m = 0.0;
  double by_m = 0.0;
};

// Computes the distance of two surfaces (without radii): descends both trees, nearer boxes first,
// to the triangles. Boxes are compared in single precision, minus the rounding error; triangles in
// double. Holds references; one query each.
class SurfaceDescent {
 public:
  // Finds distances below limit_m, and stops once below enough_m.
  SurfaceDescent(const SurfaceTree& a, const SurfaceTree& b, const Eigen::Isometry3d& X_AB,
                 double limit_m, double enough_m);

  void pass_over(KeptApart* kept) { kept_.apart = kept; }
  void allow(const Roughness& rough) { rough_ = rough; }
  // Returns min(distance, limit), never larger than the true value. Above enough_m, less than 1e-9
  // m below it, plus allow().
  [[nodiscard]] double run();
  // After run() with a result above zero and below the limit: direction from a to b of the nearest
  // triangles, in A's frame.
  [[nodiscard]] const Eigen::Vector3d& direction() const { return n_A_; }
  // After run(): true if the two root boxes are apart.
  [[nodiscard]] bool boxes_apart() const { return roots_m_ > 0.0; }

 private:
  using Box = SurfaceTree::Box;
  using Node = SurfaceTree::Node;
  // One tree's frame X in the other's frame S: rotation, its absolute values, translation; and the
  // latest separating direction towards X, which separates most other triangles too.
  struct Turn {
    Eigen::Matrix3f R;
    Eigen::Matrix3f width;
    Eigen::Vector3f p;
    Eigen::Vector3f n_S = Eigen::Vector3f::Zero();
    Eigen::Vector3f n_width_S = Eigen::Vector3f::Zero();
    Eigen::Vector3f n_width_X = Eigen::Vector3f::Zero();
  };
  struct Gaps {
    Eigen::Array4f least_m;  // lower bound of the distance
    Eigen::Array4f along_m;  // lower bound of the separation along n
    Eigen::Array4f order;    // visiting order, lowest first; deep overlaps before shallow
  };
  [[nodiscard]] static Turn turn_of(const Eigen::Isometry3d& X);
  [[nodiscard]] Gaps gaps(const Box& box, const Node& others, const Turn& turn) const;
  void part_along(const Eigen::Vector3d& n_A);
  void visit(const Box& a, const Box& b);
  void measure(std::uint32_t a, std::uint32_t b);

  const SurfaceTree& a_;
  const SurfaceTree& b_;
  Eigen::Isometry3d X_AB_;
  Eigen::Vector3d n_A_ = Eigen::Vector3d::Zero();  // separating direction, from a to b
  Eigen::Vector3d n_B_ = Eigen::Vector3d::Zero();  // the same in B's frame
  double n_offset_m_ = 0.0;                        // position of B's origin along n_A_
  Turn of_b_in_a_;
  Turn of_a_in_b_;
  struct Rounding {
    float boxes_m;
    double triangles_m;
  };
  Rounding rounding_;
  // Returns the lower bound from which pairs are skipped.
  [[nodiscard]] double passes_at() const {
    return rough_.by_m > 0.0
               ? std::max(best_m_ - rough_.by_m, std::min(best_m_, rough_.exact_below_m))
               : best_m_;
  }

  double best_m_;
  double passed_m_ = std::numeric_limits<double>::infinity();  // smallest lower bound skipped
  double enough_m_;
  Roughness rough_;
  double roots_m_ = 0.0;
  struct Kept {
    KeptApart* apart = nullptr;
    double along_m;  // skip beyond this along n_A_
  };
  Kept kept_;
  // Recently measured pairs of triangles (key plus one), because leaves may share triangles.
  std::array<std::uint64_t, 128> measured_{};
};

// Returns a point's distance from the surface, inside or outside (no radius).
[[nodiscard]] double distance_to_surface(const SurfaceTree& tree, const Eigen::Vector3d& p_T);

}  // namespace armloom

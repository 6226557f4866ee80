#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/geometry/mesh/surface_tree.h"
#include "core/geometry/surface/triangle_distance.h"

namespace armloom {

// What of two surfaces is left out of account though it is closer than asked. All in the frame of
// A's tree; directions of unit length, from A to B.
class KeptApart {
 public:
  virtual ~KeptApart() = default;
  // Two triangles, with the direction that parts them (TriangleGap).
  [[nodiscard]] virtual bool keeps(const TrianglePoints& a, const TrianglePoints& b,
                                   const Eigen::Vector3d& n) = 0;
  // Of both surfaces whatever is so far apart along n.
  [[nodiscard]] virtual double enough_along(const Eigen::Vector3d& n) const = 0;
};

// A distance that may be told up to by_m too small, unless it is below exact_below_m.
struct Roughness {
  double exact_below_m = 0.0;
  double by_m = 0.0;
};

// The distance of two surfaces (without radii): both trees from the root down, the nearer boxes
// first, and triangles at the end. Boxes are compared in single precision, four in one step, and
// what rounding may do is taken off; triangles in double. Holds references; one question each.
class SurfaceDescent {
 public:
  // Looks for what is closer than limit_m, and no further once something is closer than enough_m.
  SurfaceDescent(const SurfaceTree& a, const SurfaceTree& b, const Eigen::Isometry3d& X_AB,
                 double limit_m, double enough_m);

  void pass_over(KeptApart* kept) { kept_.apart = kept; }
  void allow(const Roughness& rough) { rough_ = rough; }
  // min(distance, limit), never larger than the true one; above enough_m less than 1e-9 m below it,
  // and what is allowed.
  [[nodiscard]] double run();
  // After run(), of surfaces apart and below the limit: the direction from a to b of the nearest
  // triangles, in A's frame.
  [[nodiscard]] const Eigen::Vector3d& direction() const { return n_A_; }
  // After run(): whether the boxes around all of A and all of B keep apart.
  [[nodiscard]] bool boxes_apart() const { return roots_m_ > 0.0; }

 private:
  using Box = SurfaceTree::Box;
  using Node = SurfaceTree::Node;
  // One tree's frame X in the other's, S: rotation, its absolute values, translation; and a
  // direction towards X that parted the nearest triangles so far: it parts most of the others.
  struct Turn {
    Eigen::Matrix3f R;
    Eigen::Matrix3f width;
    Eigen::Vector3f p;
    Eigen::Vector3f n_S = Eigen::Vector3f::Zero();
    Eigen::Vector3f n_width_S = Eigen::Vector3f::Zero();
    Eigen::Vector3f n_width_X = Eigen::Vector3f::Zero();
  };
  struct Gaps {
    Eigen::Array4f least_m;  // no distance is below it
    Eigen::Array4f along_m;  // nor along n is any
    Eigen::Array4f order;  // what to look at first: of boxes that overlap, those that do so deeply
  };
  [[nodiscard]] static Turn turn_of(const Eigen::Isometry3d& X);
  [[nodiscard]] Gaps gaps(const Box& box, const Node& others, const Turn& turn) const;
  void part_along(const Eigen::Vector3d& n_A);
  void visit(const Box& a, const Box& b);
  void measure(std::uint32_t a, std::uint32_t b);

  const SurfaceTree& a_;
  const SurfaceTree& b_;
  Eigen::Isometry3d X_AB_;
  Eigen::Vector3d n_A_ = Eigen::Vector3d::Zero();  // that direction, from a to b
  Eigen::Vector3d n_B_ = Eigen::Vector3d::Zero();  // the same in B's frame, ...
  double n_offset_m_ = 0.0;                        // ... whose origin is so far along it
  Turn of_b_in_a_;
  Turn of_a_in_b_;
  struct Rounding {
    float boxes_m;
    double triangles_m;
  };
  Rounding rounding_;
  // What is so far apart is passed over: as the distance can be no smaller, or hardly.
  [[nodiscard]] double passes_at() const {
    return rough_.by_m > 0.0
               ? std::max(best_m_ - rough_.by_m, std::min(best_m_, rough_.exact_below_m))
               : best_m_;
  }

  double best_m_;
  double passed_m_ = std::numeric_limits<double>::infinity();  // the least of what was passed over
  double enough_m_;
  Roughness rough_;
  double roots_m_ = 0.0;
  struct Kept {
    KeptApart* apart = nullptr;
    double along_m;  // what is so far apart along n_A_ is left out
  };
  Kept kept_;
  // Pairs of triangles that were measured, as several leaves may have them: the last at each place,
  // plus one.
  std::array<std::uint64_t, 128> measured_{};
};

// How far a point is from the surface, inside or outside (no radius).
[[nodiscard]] double distance_to_surface(const SurfaceTree& tree, const Eigen::Vector3d& p_T);

}  // namespace armloom

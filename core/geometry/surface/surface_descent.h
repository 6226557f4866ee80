#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/geometry/mesh/surface_tree.h"
#include "core/geometry/surface/triangle_distance.h"

namespace armloom {

// Decides which pairs of triangles may be skipped although they are closer than the query distance.
// All arguments are in the frame of A's tree; directions have unit length and point from A to B.
class KeptApart {
 public:
  virtual ~KeptApart() = default;
  // Returns true if two triangles may be skipped; n separates them (TriangleGap).
  [[nodiscard]] virtual bool keeps(const TrianglePoints& a, const TrianglePoints& b,
                                   const Eigen::Vector3d& n) = 0;
  // Returns a distance (m). Boxes and triangles that are separated by at least this along n are
  // skipped.
  [[nodiscard]] virtual double enough_along(const Eigen::Vector3d& n) const = 0;
};

// Permits results that are up to by_m too small, for distances of exact_below_m or more.
struct Roughness {
  double exact_below_m = 0.0;
  double by_m = 0.0;
};

// Computes the distance of two surfaces, without radii. Descends both trees to the triangles,
// nearer boxes first. Boxes are compared in single precision, triangles in double precision; the
// rounding error is subtracted. Keeps references to the trees. Each object serves a single query.
class SurfaceDescent {
 public:
  // Searches for distances below limit_m, and stops as soon as a distance below enough_m is found.
  SurfaceDescent(const SurfaceTree& a, const SurfaceTree& b, const Eigen::Isometry3d& X_AB,
                 double limit_m, double enough_m);

  void pass_over(KeptApart* kept) { kept_.apart = kept; }
  void allow(const Roughness& rough) { rough_ = rough; }
  // Returns min(distance, limit_m), never a larger value. A result above enough_m is less than 1e-9
  // m too small, plus what allow() permits.
  [[nodiscard]] double run();
  // Returns the unit direction from the nearest triangle of a to that of b, in A's frame.
  // Precondition: run() returned a result above zero and below the limit.
  [[nodiscard]] const Eigen::Vector3d& direction() const { return n_A_; }
  // Returns true if the boxes around the whole surfaces are apart. Precondition: run() was called.
  [[nodiscard]] bool boxes_apart() const { return roots_m_ > 0.0; }

 private:
  using Box = SurfaceTree::Box;
  using Node = SurfaceTree::Node;
  // The pose of one tree's frame X in the other tree's frame S: rotation, its absolute values, and
  // translation. Also the latest separating direction n towards X, which separates most other
  // triangles too: in S, and its absolute values in S and in X.
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
  // Returns a distance (m): pairs whose lower bound is at least this are skipped.
  [[nodiscard]] double passes_at() const {
    return rough_.by_m > 0.0
               ? std::max(best_m_ - rough_.by_m, std::min(best_m_, rough_.exact_below_m))
               : best_m_;
  }

  double best_m_;
  // Smallest lower bound of a skipped pair.
  double passed_m_ = std::numeric_limits<double>::infinity();
  double enough_m_;
  Roughness rough_;
  double roots_m_ = 0.0;
  struct Kept {
    KeptApart* apart = nullptr;
    double along_m;  // pairs separated by at least this along n_A_ are skipped
  };
  Kept kept_;
  // Keys (plus one) of recently measured pairs of triangles. Leaves may share triangles, and this
  // avoids measuring a pair twice.
  std::array<std::uint64_t, 128> measured_{};
};

// Returns the distance of a point from the surface (without radius), whether it is inside or
// outside.
[[nodiscard]] double distance_to_surface(const SurfaceTree& tree, const Eigen::Vector3d& p_T);

}  // namespace armloom

#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/geometry/ball.h"
#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Balls inside a solid. If balls of two solids overlap, the solids overlap too. Immutable.
class InnerBalls {
 public:
  InnerBalls() = default;  // no balls
  explicit InnerBalls(const std::vector<Ball>& balls);

  // Returns true if one of these balls and one of `others` are certainly closer than limit_m, or
  // overlap. X is the pose of the others' frame in this frame. Computes in single precision;
  // rounding cannot make the result true.
  [[nodiscard]] bool surely_meet(const InnerBalls& others, const Eigen::Isometry3d& X,
                                 double limit_m) const;

 private:
  // Four balls, by coordinate. The radius of an unused ball is far below zero.
  struct Four {
    Eigen::Array4f x;
    Eigen::Array4f y;
    Eigen::Array4f z;
    Eigen::Array4f radius_m;
  };
  std::vector<Four> fours_;
  double reach_m_ = 0.0;  // distance of the balls' farthest point from the origin
};

// Returns at most kInnerBalls large balls inside a solid that lies in the box with this center and
// these half sides. For a point inside, depth_m returns a lower bound of its distance to the
// surface; for any other point, zero or less. It is called about 500 times.
inline constexpr std::size_t kInnerBalls = 16;
using Depth = std::function<double(const Eigen::Vector3d& p)>;
[[nodiscard]] std::vector<Ball> inner_balls(const Eigen::Vector3d& center,
                                            const Eigen::Vector3d& half_m, const Depth& depth_m);
// Returns balls inside a surface, or an empty list if the surface encloses no volume. Takes some
// milliseconds.
[[nodiscard]] std::vector<Ball> inner_balls(const SurfaceTree& tree);

}  // namespace armloom

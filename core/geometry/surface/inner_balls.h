#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/geometry/ball.h"
#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Balls inside a solid: if those of two solids overlap, so do the solids. Immutable.
class InnerBalls {
 public:
  InnerBalls() = default;  // no balls
  explicit InnerBalls(const std::vector<Ball>& balls);

  // Returns true if a ball of these and a ball of `others` (X: their frame in this frame) are
  // certainly closer than limit_m or overlap. Single precision, minus the rounding error.
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
  double reach_m_ = 0.0;  // largest reach of a ball from the origin
};

// Returns at most kInnerBalls large balls inside a solid in the box about `center`. depth_m returns
// a lower bound of an inside point's distance to the surface, at most zero elsewhere, and is called
// about 500 times.
inline constexpr std::size_t kInnerBalls = 16;
using Depth = std::function<double(const Eigen::Vector3d& p)>;
[[nodiscard]] std::vector<Ball> inner_balls(const Eigen::Vector3d& center,
                                            const Eigen::Vector3d& half_m, const Depth& depth_m);
// Returns balls inside a surface, none if it encloses nothing. Takes some milliseconds.
[[nodiscard]] std::vector<Ball> inner_balls(const SurfaceTree& tree);

}  // namespace armloom

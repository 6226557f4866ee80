#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/geometry/ball.h"
#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Balls inside a solid. If balls of two solids overlap, the solids do, without GJK or a triangle
// test. Immutable.
class InnerBalls {
 public:
  InnerBalls() = default;  // no balls
  explicit InnerBalls(const std::vector<Ball>& balls);

  // Returns true if a ball of these and a ball of `others` are certainly closer than limit_m or
  // overlap. X: pose of the others' frame in this frame. Single precision, four at once; the
  // rounding error is subtracted.
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

// Returns at most kInnerBalls large balls inside a solid that lies in the box about `center`.
// depth_m returns a lower bound of an inside point's distance to the surface, and at most zero
// elsewhere. It is called about 500 times.
inline constexpr std::size_t kInnerBalls = 16;
using Depth = std::function<double(const Eigen::Vector3d& p)>;
[[nodiscard]] std::vector<Ball> inner_balls(const Eigen::Vector3d& center,
                                            const Eigen::Vector3d& half_m, const Depth& depth_m);
// Returns balls inside a surface, none if it encloses nothing. Takes some milliseconds.
[[nodiscard]] std::vector<Ball> inner_balls(const SurfaceTree& tree);

}  // namespace armloom

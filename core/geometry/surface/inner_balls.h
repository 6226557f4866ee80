#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/geometry/ball.h"
#include "core/geometry/mesh/surface_tree.h"

namespace armloom {

// Balls that lie in a solid: where those of two overlap, the solids do, and neither GJK nor a
// triangle is asked. Immutable.
class InnerBalls {
 public:
  InnerBalls() = default;  // none
  explicit InnerBalls(const std::vector<Ball>& balls);

  // Whether it is certain that a ball of these and one of the others, whose frame stands at X, come
  // closer than limit_m, or overlap. In single precision, four at once; what rounding may do is
  // taken off.
  [[nodiscard]] bool surely_meet(const InnerBalls& others, const Eigen::Isometry3d& X,
                                 double limit_m) const;

 private:
  // Coordinate by coordinate. Of one that is not there the radius is far below zero.
  struct Four {
    Eigen::Array4f x;
    Eigen::Array4f y;
    Eigen::Array4f z;
    Eigen::Array4f radius_m;
  };
  std::vector<Four> fours_;
  double reach_m_ = 0.0;  // of the farthest center from the origin
};

// Large ones inside of a solid that lies in the box about `center`, at most kInnerBalls. depth_m:
// how far a point inside of it is from its surface, or less; not above zero elsewhere. It is asked
// some 500 times.
inline constexpr std::size_t kInnerBalls = 16;
using Depth = std::function<double(const Eigen::Vector3d& p)>;
[[nodiscard]] std::vector<Ball> inner_balls(const Eigen::Vector3d& center,
                                            const Eigen::Vector3d& half_m, const Depth& depth_m);
// The same inside of a surface, none where it encloses nothing; some milliseconds.
[[nodiscard]] std::vector<Ball> inner_balls(const SurfaceTree& tree);

}  // namespace armloom

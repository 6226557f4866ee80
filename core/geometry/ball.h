#pragma once

#include <Eigen/Core>

namespace armloom {

// A ball; a point if its radius is zero.
struct Ball {
  Eigen::Vector3d center;
  double radius_m = 0.0;
};

}  // namespace armloom

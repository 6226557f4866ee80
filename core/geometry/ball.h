#pragma once

#include <Eigen/Core>

namespace armloom {

// A radius of zero: a point.
struct Ball {
  Eigen::Vector3d center;
  double radius_m = 0.0;
};

}  // namespace armloom

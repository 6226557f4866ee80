#pragma once

#include <Eigen/Core>

namespace armloom {

struct Ball {
  Eigen::Vector3d center;
  double radius_m = 0.0;
};

}  // namespace armloom

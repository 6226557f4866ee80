#pragma once

#include <Eigen/Core>
#include <vector>

namespace armloom {

// Unit vectors that lie evenly on the sphere (Fibonacci's spiral).
[[nodiscard]] std::vector<Eigen::Vector3d> spread_directions(int count);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <vector>

namespace armloom {

// Returns unit vectors spread evenly over the sphere (Fibonacci spiral).
[[nodiscard]] std::vector<Eigen::Vector3d> spread_directions(int count);

}  // namespace armloom

#include "core/geometry/spread_directions.h"

#include <cmath>
#include <numbers>

namespace armloom {

std::vector<Eigen::Vector3d> spread_directions(int count) {
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Eigen::Vector3d> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double r = std::sqrt(1.0 - z * z);
    directions.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), z);
  }
  return directions;
}

}  // namespace armloom

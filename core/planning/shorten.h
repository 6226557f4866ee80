#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace armloom {

struct Shortening {
  std::function<bool(const Eigen::VectorXd&, const Eigen::VectorXd&)> is_free;
  std::function<bool()> stop;
  std::uint64_t seed;
  int tries = 60;  // random lines to try; ends early after 25 failures in a row
};

// Shortens a path whose lines are free: drops unneeded points and joins random positions by
// straight lines (Geraerts and Overmars, "Creating High-quality Paths for Motion Planning", 2007,
// 3.2). Keeps both ends.
[[nodiscard]] double length_of(const std::vector<Eigen::VectorXd>& points);  // Euclidean
void shorten(std::vector<Eigen::VectorXd>& points, const Shortening& by);

}  // namespace armloom

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
  int tries = 60;  // of lines between random places; as many fail in a row: it ends sooner
};

// A way whose lines are free, shorter: points that are not needed are left out, then random places
// of it are joined by straight lines (Geraerts and Overmars, "Creating High-quality Paths for
// Motion Planning", 2007, 3.2), in turn. Ends stay.
[[nodiscard]] double length_of(const std::vector<Eigen::VectorXd>& points);  // Euclidean
void shorten(std::vector<Eigen::VectorXd>& points, const Shortening& by);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <iterator>

namespace armloom {

// Returns a point of the Halton sequence, whose points spread evenly over the unit cube. Each of up
// to ten dimensions has its own prime as base. `index` starts at 1; each coordinate is in [0, 1).
[[nodiscard]] inline Eigen::VectorXd halton(int index, Eigen::Index dimensions) {
  constexpr int kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29};
  Eigen::VectorXd place(dimensions);
  for (Eigen::Index d = 0; d < dimensions; ++d) {
    const int base = kPrimes[static_cast<std::size_t>(d) % std::size(kPrimes)];
    double share = 0.0, digit = 1.0;
    for (int i = index; i > 0; i /= base) share += (digit /= base) * (i % base);
    place[d] = share;
  }
  return place;
}

}  // namespace armloom

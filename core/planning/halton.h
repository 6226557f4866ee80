#pragma once

#include <Eigen/Core>
#include <iterator>

namespace armloom {

// The Halton sequence, a prime for each dimension: places spread over the unit cube, the same every
// time. From 1 on; each coordinate in [0, 1).
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

#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "test/scenarios/crowded_workloads.h"

namespace armloom {

// Tells by plain geometry whether a crowded world can still be brought to its end: whole motions of
// clients one after the other, or several that begin together, with the distances that solutions
// keep. Moves aside that no client asks for are not among them. What it calls solvable is; what it
// does not may still be for those who pause on the way.
class CrowdedOracle {
 public:
  explicit CrowdedOracle(const CrowdedWorkload& world);

  // `done`: by arm, how many of its motions have been made (or are certain to be).
  [[nodiscard]] bool solvable(const std::vector<std::size_t>& done);

 private:
  [[nodiscard]] bool free(const std::vector<std::size_t>& done, unsigned together);
  [[nodiscard]] Eigen::Vector2d stands(std::size_t arm, std::size_t done) const;

  const CrowdedWorkload& world_;
  std::vector<std::vector<DiscMotion>> queues_;  // by arm, as submitted
  std::map<std::vector<std::size_t>, bool> known_;
};

}  // namespace armloom

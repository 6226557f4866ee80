#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "test/scenarios/crowded_workloads.h"

namespace armloom {

// Decides by plain geometry whether a crowded world can still be finished. Client motions run as a
// whole, one after the other or several that start together, and keep the distances that solutions
// keep. Sound but not complete: retreats and pauses on a path may solve more worlds.
class CrowdedOracle {
 public:
  explicit CrowdedOracle(const CrowdedWorkload& world);

  // `done`: for each arm, the number of motions that are finished (or certain to finish).
  [[nodiscard]] bool solvable(const std::vector<std::size_t>& done);

 private:
  [[nodiscard]] bool free(const std::vector<std::size_t>& done, unsigned together);
  [[nodiscard]] Eigen::Vector2d stands(std::size_t arm, std::size_t done) const;

  const CrowdedWorkload& world_;
  std::vector<std::vector<DiscMotion>> queues_;  // by arm, in submission order
  std::map<std::vector<std::size_t>, bool> known_;
};

}  // namespace armloom

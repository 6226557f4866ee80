#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// A candidate for an arm's home (Arm::joints order, within limits), and its required clearance from
// the scene and from the arms before it.
struct HomePlace {
  Eigen::VectorXd q;
  double clearance_m;  // at least the cell's
};
using HomePlaces = std::vector<std::vector<HomePlace>>;

// Returns for each arm the index of the first candidate, in arm order, with which all arms are
// free, each also of itself by the cell's self_clearance_m. nullopt if none was found in
// kHomeChecksMax checks. Precondition: one entry per arm. Problems: those of PlanningScene::build.
inline constexpr std::size_t kHomeChecksMax = 5'000;
[[nodiscard]] Result<std::optional<std::vector<std::size_t>>> find_free_homes(
    const CellPtr& cell, const HomePlaces& places);

}  // namespace armloom

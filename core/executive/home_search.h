#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// A candidate for an arm's home: a position (in the order of Arm::joints, within limits), and the
// clearance that it must have from the scene and from the arms before it.
struct HomePlace {
  Eigen::VectorXd q;
  double clearance_m;  // at least the cell's
};
using HomePlaces = std::vector<std::vector<HomePlace>>;

// Chooses one candidate for each arm such that all arms keep their required clearances and the
// cell's self_clearance_m. Returns the indices by arm; earlier candidates of earlier arms are
// preferred. nullopt if kHomeChecksMax checks find no choice. Precondition: `places` has one entry
// per arm. Problems: those of PlanningScene::build.
inline constexpr std::size_t kHomeChecksMax = 5'000;
[[nodiscard]] Result<std::optional<std::vector<std::size_t>>> find_free_homes(
    const CellPtr& cell, const HomePlaces& places);

}  // namespace armloom

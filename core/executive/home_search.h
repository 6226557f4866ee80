#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// A configuration (Arm::joints order, within limits) that may be an arm's home, and what it has to
// keep from the scene and the arms before it.
struct HomePlace {
  Eigen::VectorXd q;
  double clearance_m;  // at least the cell's
};
// For each arm, what is wanted most first.
using HomePlaces = std::vector<std::vector<HomePlace>>;

// For each arm the index of the place with which all arms stand free, each of itself by the cell's
// self_clearance_m: the first such choice when arms are looked at in their order. Nullopt: none was
// found in kHomeChecksMax looks.
// Precondition: one entry per arm of the cell.
// Problems: as PlanningScene::build.
inline constexpr std::size_t kHomeChecksMax = 5'000;
[[nodiscard]] Result<std::optional<std::vector<std::size_t>>> find_free_homes(
    const CellPtr& cell, const HomePlaces& places);

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/planning/planner.h"

namespace armloom {

// Joint positions at which the arm keeps its distances from all that stands as the request says,
// within its limits, as near to `wanted` as is found: of places around it (places_around.h) the
// first free ones, each brought as near as it stays free, by as few joints as that takes. Nothing:
// none is.
// Thread-safe; the same in, the same out.
struct NearestFree {
  std::optional<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;
};
[[nodiscard]] NearestFree nearest_free(const PlanningScenePtr& scene, const PlanRequest& request,
                                       const Eigen::VectorXd& wanted);
// So many free places are brought nearer.
inline constexpr int kFreePlacesMax = 8;

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/planning/planner.h"

namespace armloom {

// Joint positions near `wanted` and within the limits, at which the arm keeps its clearances from
// everything else as in the request; nullopt if none were found. The first free candidates around
// `wanted` (places_around.h) are moved toward it as far as they stay free. As few joints as
// possible then differ from `wanted`. Thread-safe and deterministic.
struct NearestFree {
  std::optional<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;
};
[[nodiscard]] NearestFree nearest_free(const PlanningScenePtr& scene, const PlanRequest& request,
                                       const Eigen::VectorXd& wanted);
// Maximum number of free candidates that are moved toward `wanted`.
inline constexpr int kFreePlacesMax = 8;

}  // namespace armloom

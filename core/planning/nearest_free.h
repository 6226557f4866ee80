#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "core/planning/planner.h"

namespace armloom {

// Joint positions near `wanted`, within the limits, at which the arm keeps its clearances from
// everything as in the request; nullopt if none was found. The first free places around `wanted`
// (places_around.h) are moved toward it while they stay free, by as few joints as possible.
// Thread-safe and deterministic.
struct NearestFree {
  std::optional<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;
};
[[nodiscard]] NearestFree nearest_free(const PlanningScenePtr& scene, const PlanRequest& request,
                                       const Eigen::VectorXd& wanted);
// Number of free places that are moved nearer.
inline constexpr int kFreePlacesMax = 8;

}  // namespace armloom

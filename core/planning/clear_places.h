#pragma once

#include <Eigen/Core>
#include <tl/expected.hpp>
#include <vector>

#include "core/planning/places_around.h"
#include "core/planning/planner.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// An arm that blocks a motion of other arms. It must clear the part of the motion after `progress`.
struct InTheWay {
  ArmId arm;
  TrajectoryPtr motion;
  Duration progress{};
};

// Joint positions of the arm, nearest first. At each of them the arm keeps its clearances from
// everything else in configuration `at`, and the motion keeps its clearances from the arm.
// Candidates are kPlacesLookedAt points of the Halton sequence in a box around the arm's position;
// the box grows up to the joints' limits. Refused (goal_not_reached) if no candidate is clear.
// Thread-safe and deterministic.
struct ClearPlaces {
  std::vector<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;  // checks of states and motions
};
[[nodiscard]] tl::expected<ClearPlaces, PlanRefusal> places_clear_of(const PlanningScenePtr& scene,
                                                                     const InTheWay& way,
                                                                     const Configuration& at);
inline constexpr std::size_t kClearPlacesMax = 4;

}  // namespace armloom

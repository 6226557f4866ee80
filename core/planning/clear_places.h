#pragma once

#include <Eigen/Core>
#include <tl/expected.hpp>
#include <vector>

#include "core/planning/places_around.h"
#include "core/planning/planner.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// An arm, and what remains of a motion of others that it is to make way for.
struct InTheWay {
  ArmId arm;
  TrajectoryPtr motion;
  Duration progress{};
};

// Joint positions at which the arm keeps its distances from all that stands at `at`, and the motion
// its own from the arm: those that are found near where it stands, the nearest first. Places of the
// Halton sequence in a box that grows around that, up to the joints' limits; so many are looked at.
// Refused (goal_not_reached): none of them is. Thread-safe; the same question has the same answer.
struct ClearPlaces {
  std::vector<Eigen::VectorXd> q;
  std::uint64_t evaluations = 0;  // of states and motions
};
[[nodiscard]] tl::expected<ClearPlaces, PlanRefusal> places_clear_of(const PlanningScenePtr& scene,
                                                                     const InTheWay& way,
                                                                     const Configuration& at);
inline constexpr std::size_t kClearPlacesMax = 4;

}  // namespace armloom

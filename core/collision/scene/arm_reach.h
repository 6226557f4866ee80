#pragma once

#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/ball.h"

namespace armloom {

// Returns the largest distance by which the link's prismatic joint can shift the link (m); zero for
// other joints.
[[nodiscard]] double travel_m(const Cell& cell, const Link& link);

// Returns a ball (world, m) that contains all links and attached objects of the arm at all joint
// positions within the limits. Precondition: `bodies` already contains these links and objects.
[[nodiscard]] Ball reach_of(const PlanningScene::Bodies& bodies, ArmId arm);

// Returns true if everything in one ball keeps `clearance_m` from everything in the other ball.
// This holds even if joints exceed their limits by the errors that the cell tolerates.
[[nodiscard]] bool out_of_reach(const Ball& one, const Ball& other, double clearance_m);

}  // namespace armloom

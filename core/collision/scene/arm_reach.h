#pragma once

#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/ball.h"

namespace armloom {

// Returns how far the link's prismatic joint can shift it (m); zero for other joints.
[[nodiscard]] double travel_m(const Cell& cell, const Link& link);

// Returns a ball (world, m) around all links and attached objects of the arm at all joint positions
// within the limits. Precondition: `bodies` has these links and objects.
[[nodiscard]] Ball reach_of(const PlanningScene::Bodies& bodies, ArmId arm);

// Returns true if the contents of both balls keep `clearance_m`, even if joints leave their limits
// by what the cell tolerates.
[[nodiscard]] bool out_of_reach(const Ball& one, const Ball& other, double clearance_m);

}  // namespace armloom

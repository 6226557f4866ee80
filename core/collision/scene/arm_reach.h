#pragma once

#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/ball.h"

namespace armloom {

// Returns how far the link's joint can push its load (m); zero if the joint is not prismatic.
[[nodiscard]] double travel_m(const Cell& cell, const Link& link);

// Returns a ball (world, m) that contains all links and held objects of the arm at all joint
// positions within the limits. Precondition: `bodies` has all links and held objects.
[[nodiscard]] Ball reach_of(const PlanningScene::Bodies& bodies, ArmId arm);

// Returns true if the contents of both balls keep `clearance_m`, even if joints leave their limits
// as far as the cell tolerates.
[[nodiscard]] bool out_of_reach(const Ball& one, const Ball& other, double clearance_m);

}  // namespace armloom

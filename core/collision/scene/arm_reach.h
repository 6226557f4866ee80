#pragma once

#include "core/collision/scene/scene_bodies.h"
#include "core/geometry/ball.h"

namespace armloom {

// Returns how far the link's joint can push what it carries; zero if that does not slide (m).
[[nodiscard]] double travel_m(const Cell& cell, const Link& link);

// Returns a ball that holds all that the arm moves and holds, wherever its joints are within their
// limits (world, m). Precondition: the bodies of links and of what is held are there.
[[nodiscard]] Ball reach_of(const PlanningScene::Bodies& bodies, ArmId arm);

// Whether nothing in one ball comes closer than `clearance_m` to anything in the other, also where
// joints are as far outside their limits as the cell tolerates.
[[nodiscard]] bool out_of_reach(const Ball& one, const Ball& other, double clearance_m);

}  // namespace armloom

#pragma once

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Every pair of bodies that is closer than the cell's clearance_m (of an arm from itself:
// self_clearance_m) while all arms stand at home, with its distance: such a cell is refused. Empty:
// the homes are free. Points at the home of the arm that the first body belongs to
// ("/robots/0/arms/0/home").
[[nodiscard]] Problems check_home(const PlanningScenePtr& scene);

}  // namespace armloom

#pragma once

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Returns every pair of bodies that is closer than its limit while all arms are at home, with its
// distance: clearance_m, or self_clearance_m or mount_clearance_m for an arm with itself or its
// mount. Such a cell is refused. Empty if the homes are free. Each pointer names the home of the
// first body's arm ("/robots/0/arms/0/home").
[[nodiscard]] Problems check_home(const PlanningScenePtr& scene);

}  // namespace armloom

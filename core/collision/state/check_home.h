#pragma once

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Returns a problem for each pair that is closer than its limit (clearance_m, self_clearance_m,
// mount_clearance_m) with all arms at home, with the distance. A cell with such a problem is
// refused. Its pointer names the home of the first body's arm ("/robots/0/arms/0/home").
[[nodiscard]] Problems check_home(const PlanningScenePtr& scene);

}  // namespace armloom

#pragma once

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Returns all pairs that are closer than their limits (clearance_m, self_clearance_m,
// mount_clearance_m) with all arms at home, each with its distance. Such a cell is refused. Each
// pointer names the home of the first body's arm ("/robots/0/arms/0/home").
[[nodiscard]] Problems check_home(const PlanningScenePtr& scene);

}  // namespace armloom

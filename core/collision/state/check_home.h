#pragma once

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

// Returns a problem for each pair that is closer than its limit (clearance_m, self_clearance_m,
// mount_clearance_m) with all arms at home, with the distance. A cell with such a problem is
// refused. Its pointer names the home of the first body's arm ("/robots/0/arms/0/home").
[[nodiscard]] Problems check_home(const PlanningScenePtr& scene);

// Returns the SRDF element that disables the checks of two links of one arm, with the names that
// the SRDF uses: <disable_collisions link1="link_5" link2="link_7" reason="Never"/>. `a` and `b`
// are names in the cell.
[[nodiscard]] std::string disabling_element(const Cell& cell, const std::string& a,
                                            const std::string& b);

}  // namespace armloom

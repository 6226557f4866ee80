#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/collision/scene/scene_bodies.h"

namespace armloom {

// Returns each arm with the objects that its mount may touch (indices in Bodies::bodies).
[[nodiscard]] std::vector<std::pair<ArmId, std::size_t>> objects_below(
    const PlanningScene::Bodies& bodies);

}  // namespace armloom

#pragma once

#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"

namespace armloom {

using SceneObjects = std::vector<CollisionObject>;

// The objects of a scene, changed as a client asks. Problems: a name that is in use (of an object,
// a link or a robot), or unknown.
[[nodiscard]] Result<SceneObjects> with_object(const PlanningScene& scene, CollisionObject added);
[[nodiscard]] Result<SceneObjects> with_other_object(const PlanningScene& scene,
                                                     CollisionObject replacing);
[[nodiscard]] Result<SceneObjects> without_object(const PlanningScene& scene,
                                                  const std::string& name);

}  // namespace armloom

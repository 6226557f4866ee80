#pragma once

#include <atomic>

#include "core/coordination/plan_question.h"
#include "core/planning/plan_motion.h"

namespace armloom {

using PlanAnswer = tl::expected<PlannedMotion, PlanRefusal>;

// Finds joint positions for the goal (reach_pose) and plans the motion (plan_motion) around all
// other arms at rest. Arms that may move (PlanQuestion::may_move) are ignored if they occupy the
// start or the goal. If no path exists around the remaining arms, all arms that may move are
// ignored; the scheduler decides when they have left. If the last try also fails, returns its
// refusal. `cancelled` is polled and may be null. Thread-safe and deterministic.
[[nodiscard]] PlanAnswer answer_plan(const PlanningScenePtr& scene, const PlanQuestion& question,
                                     const std::atomic<bool>* cancelled = nullptr);

}  // namespace armloom

#pragma once

#include <atomic>

#include "core/coordination/plan_question.h"
#include "core/planning/plan_motion.h"

namespace armloom {

using PlanAnswer = tl::expected<PlannedMotion, PlanRefusal>;

// Makes the goal's pose joint positions (reach_pose) and plans the motion (plan_motion) beside all
// other arms where they stand; of those that may move, one that stands where the arm sets out or is
// to go is left out; where there is no way past the rest either, all are, as if they were gone:
// when they are is the scheduler's to see. The refusal is that of the last try. `cancelled` is read
// now and then; may be null. Thread-safe; the same question in the same scene has the same answer.
[[nodiscard]] PlanAnswer answer_plan(const PlanningScenePtr& scene, const PlanQuestion& question,
                                     const std::atomic<bool>* cancelled = nullptr);

}  // namespace armloom

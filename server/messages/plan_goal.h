#pragma once

#include <string>

#include "core/planning/plan_goal.h"
#include "server/codec/format.h"

namespace armloom {

// A goal of an arm, one of
[[nodiscard]] FormatPtr<PlanGoal> plan_goal_format();

// JSON if the text begins with "{", joint positions if with "[", else a name.
[[nodiscard]] Result<PlanGoal> read_plan_goal(const std::string& text);

}  // namespace armloom

#pragma once

#include <string>

#include "core/planning/plan_goal.h"
#include "server/codec/format.h"

namespace armloom {

// Describes a goal of an arm, which is one of
//   {"joints": [...]}      rad or m, in the order of the arm's group
//   {"named": "ready"}     a named state of the SRDF, or "home"
//   {"pose": {"link": "left_tool0", "xyz": [...], "rpy": [...]}}   of a link, in the world
[[nodiscard]] FormatPtr<PlanGoal> plan_goal_format();

// Reads a goal: JSON if the text begins with "{", joint positions if it begins with "[", else the
// name of a state.
[[nodiscard]] Result<PlanGoal> read_plan_goal(const std::string& text);

}  // namespace armloom

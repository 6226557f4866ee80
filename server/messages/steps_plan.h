#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "core/executive/plan_task.h"
#include "server/codec/format.h"
#include "server/messages/problem.h"

namespace armloom {

// Body of POST /plan: for a goal, or for a job with steps (a body of POST /jobs, with `seed` and
// `budget`).
using PlanBody = std::variant<PlanInquiry, StepsInquiry>;
[[nodiscard]] FormatPtr<PlanBody> plan_body_format();
[[nodiscard]] Result<PlanBody> read_plan_body_text(std::string_view text);

// A step of the answer, with the trajectory of a motion in the form of POST /jobs.
struct StepPlan {
  PlannedStep step;
  std::optional<TrajectoryRequest> trajectory = {};
};
[[nodiscard]] FormatPtr<StepPlan> step_plan_format();                     // step_plan.cc
[[nodiscard]] std::optional<Duration> duration_of(const StepPlan& plan);  // of a motion

// Answer to POST /plan for a job with steps that can all be planned.
struct StepsPlanAnswer {
  std::vector<StepPlan> steps;
};
[[nodiscard]] FormatPtr<StepsPlanAnswer> steps_plan_format();
[[nodiscard]] StepsPlanAnswer answer_of(const StepsPlan& plan, const Cell& cell);
// Returns the problem document (422) if a step cannot be planned, with the steps before it.
// Precondition: StepsPlan::refused is set.
[[nodiscard]] ProblemDocument document_of(const StepsPlan& plan, const Cell& cell);

}  // namespace armloom

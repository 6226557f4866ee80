#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/steps_plan.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

using namespace formats;

std::optional<Duration> duration_of(const StepPlan& plan) {
  const TrajectoryPtr& motion = plan.step.motion;
  return motion ? std::optional(motion->duration()) : std::nullopt;
}

FormatPtr<StepPlan> step_plan_format() {
  using Plan = StepPlan;
  static const auto format =
      named("PlannedStep", "A step of a job that is planned, but not executed.",
            object<Plan>({
                output_only(
                    "name", [](const Plan& plan) { return plan.step.name; }, text(),
                    "Display name; may be empty"),
                output_only(
                    "kind", [](const Plan& plan) { return plan.step.kind; }, text(),
                    "The member that names the step, as in `Step`"),
                output_only(
                    "detail", [](const Plan& plan) { return plan.step.detail; }, text(),
                    "What the step does; may be empty"),
                output_only(
                    "arms", [](const Plan& plan) { return plan.step.arms; }, list(text()),
                    "Arms that a motion moves"),
                output_if("trajectory", &Plan::trajectory, told_trajectory_format(),
                          "Only of a motion: its trajectory in the form of POST /jobs"),
                output_if(
                    "duration_s", [](const Plan& plan) { return duration_of(plan); },
                    seconds(kPositive), "Only of a motion"),
                output_only(
                    "evaluations", [](const Plan& plan) { return plan.step.evaluations; }, count(),
                    "Line segments checked by the search"),
            }));
  return format;
}

}  // namespace armloom

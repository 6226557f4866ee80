#include "server/messages/steps_plan.h"

#include <memory>
#include <stdexcept>
#include <utility>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_motion.h"
#include "server/messages/job_request.h"
#include "server/messages/plan.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

using namespace formats;

namespace {

FormatPtr<StepsInquiry> steps_inquiry_format() {
  using Inquiry = StepsInquiry;
  return named("StepsPlanRequest", "A job with steps whose motions are planned, but not executed.",
               object<Inquiry>({
                   inlined(&Inquiry::job, steps_job_parts()),
                   search_parts<Inquiry>(),
               }));
}

class PlanBodyFormat final : public CustomFormat<PlanBody> {
 public:
  void read(const JsonNode& node, PlanBody& out) const override {
    if (node.raw().is_object() && node.has("steps")) {
      steps_->read(node, out.emplace<StepsInquiry>());
    } else {
      goal_->read(node, out.emplace<PlanInquiry>());
    }
  }
  void write(JsonWriter&, const PlanBody&) const override {
    throw std::logic_error("a request is never written");
  }
  Schema schema(Way way) const override {
    return {{"anyOf", Schema::array({goal_->schema(way), steps_->schema(way)})}};
  }

 private:
  FormatPtr<PlanInquiry> goal_ = plan_inquiry_format();
  FormatPtr<StepsInquiry> steps_ = steps_inquiry_format();
};

Duration duration_of(const StepsPlanAnswer& answer) {
  Duration all{};
  for (const StepPlan& step : answer.steps) all += duration_of(step).value_or(Duration{});
  return all;
}

std::uint64_t evaluations_of(const StepsPlanAnswer& answer) {
  std::uint64_t all = 0;
  for (const StepPlan& step : answer.steps) all += step.step.evaluations;
  return all;
}

std::vector<StepPlan> steps_of(const StepsPlan& plan, const Cell& cell) {
  std::vector<StepPlan> steps;
  for (const PlannedStep& step : plan.steps) {
    StepPlan& told = steps.emplace_back(StepPlan{step});
    if (step.motion) told.trajectory = request_of(*step.motion, cell);
  }
  return steps;
}

}  // namespace

FormatPtr<PlanBody> plan_body_format() {
  static const FormatPtr<PlanBody> format = make_format<PlanBodyFormat>();
  return format;
}

Result<PlanBody> read_plan_body_text(std::string_view text) {
  return read_text(*plan_body_format(), text);
}

FormatPtr<StepsPlanAnswer> steps_plan_format() {
  using Answer = StepsPlanAnswer;
  static const auto format =
      named("StepsPlan", "The planned motions of a job with steps, not executed.",
            object<Answer>({
                output_only("steps", &Answer::steps, list(step_plan_format()),
                            "The steps, each motion with its trajectory"),
                output_only(
                    "duration_s", [](const Answer& answer) { return duration_of(answer); },
                    seconds(kPositive), "Sum over all motions; without actions and waits"),
                output_only(
                    "evaluations", [](const Answer& answer) { return evaluations_of(answer); },
                    count(), "Sum over all motions"),
            }));
  return format;
}

StepsPlanAnswer answer_of(const StepsPlan& plan, const Cell& cell) {
  return {steps_of(plan, cell)};
}

ProblemDocument document_of(const StepsPlan& plan, const Cell& cell) {
  const auto* problems = std::get_if<Problems>(&plan.refused);
  ProblemDocument document = problems != nullptr
                                 ? document_of(*problems)
                                 : document_of(std::get<RefusedInquiry>(plan.refused));
  document.status = 422;
  document.steps = std::make_shared<const std::vector<StepPlan>>(steps_of(plan, cell));
  return document;
}

}  // namespace armloom

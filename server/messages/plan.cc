#include "server/messages/plan.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
#include "server/codec/value_formats.h"
#include "server/messages/job.h"
#include "server/messages/job_request.h"
#include "server/messages/plan_goal.h"
#include "server/messages/trajectory_request.h"

namespace armloom {

using namespace formats;

FormatPtr<PlanInquiry> plan_inquiry_format() {
  using Inquiry = PlanInquiry;
  static const auto format = formats::named(
      "PlanRequest", "",
      object<Inquiry>({
          unless("arms", required("arm", &Inquiry::arm, name(), "That is to move")),
          field("arms", &Inquiry::arms,
                list(name(), {.fewest = 1, .most = kAlternativesMax, .noun = "arms"}),
                "Instead: the one of these that would arrive first as a job"),
          at_most_one<Inquiry>({"arm", "arms"}),
          required("to", &Inquiry::to, plan_goal_format(), "Where it is to be"),
          field("start", &Inquiry::from, plan_goal_format(),
                "Where it begins, as joints or a named state; absent: where it will be when all "
                "jobs that are accepted have run"),
          field("seed", &Inquiry::seed, count(), "Of the search: the same one repeats the plan"),
          field("budget", &Inquiry::budget, integer(1, kPlanBudgetMax),
                "Evaluations (stretches of lines) that the search may take; absent: 400,000. A way "
                "that there is takes a few thousand mostly. A straight line takes none"),
          field("velocity_scaling_factor", &Inquiry::speed, number({kVelocityScalingMin, 1.0}),
                "The share of its speed at which it goes; absent: the cell's"),
      }));
  return format;
}

Result<PlanInquiry> read_plan_inquiry_text(std::string_view text) {
  return read_text(*plan_inquiry_format(), text);
}

namespace {

FormatPtr<OtherArm> other_arm_format() {
  return object<OtherArm>({
      told("arm", &OtherArm::arm, text()),
      told("arrives_s", &OtherArm::arrives_s, nullable(number({0.0})),
           "From now; null: it has no way, or when it could go is not known"),
      told("detail", &OtherArm::detail, text()),
  });
}

}  // namespace

FormatPtr<PlanView> plan_format() {
  using View = PlanView;
  static const auto format = formats::named(
      "Plan", "A motion, not executed.",
      object<View>({
          told("arm", &View::arm, text(), "That goes"),
          told("others", &View::others, list(other_arm_format()),
               "Of `arms`, those that would not: when each would arrive, or why it cannot"),
          told(
              "trajectory", [](const View& plan) { return &plan.motion.timed.request; },
              told_trajectory_format(), "As POST /jobs takes it"),
          told(
              "duration_s",
              [](const View& plan) { return plan.motion.timed.trajectory->duration(); },
              seconds(kPositive)),
          told("length", &View::length, number({0.0}), "Of the way in joint space, rad or m"),
          told("straight_line_length", &View::straight_line_length, number({0.0}),
               "The same of the straight line"),
          told(
              "evaluations", [](const View& plan) { return plan.motion.way.evaluations; }, count(),
              "Stretches of lines that were looked at"),
          told_if(
              "verdict",
              [](const View& plan) {
                return plan.verdict ? std::optional(*plan.verdict) : std::nullopt;
              },
              verdict_format(), "What POST /check says of it now"),
          told_if(
              "not_checked_reason",
              [](const View& plan) {
                return plan.verdict ? std::nullopt
                                    : std::optional(document_of(plan.verdict.error()));
              },
              problem_format(), "Instead: why POST /jobs would refuse it now"),
      }));
  return format;
}

std::vector<std::string> links_of(const PlanRefusal& refusal) {
  if (refusal.proximity) return {refusal.proximity->body_a, refusal.proximity->body_b};
  if (refusal.link) return {*refusal.link};
  return {};
}

ProblemDocument document_of(const RefusedInquiry& refused) {
  const PlanRefusal& refusal = refused.why;
  const std::string slug = reason_name(refusal.reason);
  ProblemDocument document{.type = problem_type(slug),
                           .title = problem_title(slug),
                           .status = 422,
                           .detail = refusal.detail,
                           .evaluations = refusal.evaluations};
  if (refusal.reason == PlanRefusal::Reason::not_found) {
    document.detail += ": a larger budget or another seed may find it";
  }
  if (!refused.pointer.empty()) document.pointer = refused.pointer;
  const bool has_value = !std::holds_alternative<std::monostate>(refused.value);
  if (has_value) document.value = refused.value;
  if (auto links = links_of(refusal); !links.empty()) document.links = std::move(links);
  if (refusal.proximity) {
    document.clearance_m = refusal.proximity->clearance_m;
    document.required_clearance_m = refusal.proximity->limit_m;
  }
  if (refusal.nearest) document.nearest = {refusal.nearest->begin(), refusal.nearest->end()};
  return document;
}

}  // namespace armloom

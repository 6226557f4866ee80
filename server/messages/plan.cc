#include "server/messages/plan.h"

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/scalar_formats.h"
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
          unless("arms", required("arm", &Inquiry::arm, name(), "Arm that moves")),
          field(
              "arms", &Inquiry::arms,
              list(name(), {.fewest = 1, .most = kAlternativesMax, .noun = "arms"}),
              "Instead of `arm`: candidate arms; the plan is for the arm that would arrive first"),
          at_most_one<Inquiry>({"arm", "arms"}),
          required("to", &Inquiry::to, plan_goal_format(), "Goal of the motion"),
          field("start", &Inquiry::from, plan_goal_format(),
                "Start of the motion, as joints or a named state; default: where the arm will be "
                "after all accepted jobs"),
          search_parts<Inquiry>(),
          field("velocity_scaling_factor", &Inquiry::speed, number({kVelocityScalingMin, 1.0}),
                "Velocity scaling, 0 to 1; default: the cell's"),
      }));
  return format;
}

namespace {

FormatPtr<OtherArm> other_arm_format() {
  return object<OtherArm>({
      output_only("arm", &OtherArm::arm, text()),
      output_only(
          "arrives_s", &OtherArm::arrives_s, nullable(number({0.0})),
          "Time until arrival, from now; null if the arm has no path or its start time is unknown"),
      output_only("detail", &OtherArm::detail, text()),
  });
}

}  // namespace

FormatPtr<PlanView> plan_format() {
  using View = PlanView;
  static const auto format = formats::named(
      "Plan", "A planned motion, not executed.",
      object<View>({
          output_only("arm", &View::arm, text(), "Arm that moves"),
          output_only("others", &View::others, list(other_arm_format()),
                      "The other candidate arms: when each would arrive, or why it cannot"),
          output_only(
              "trajectory", [](const View& plan) { return &plan.motion.timed.request; },
              told_trajectory_format(), "The trajectory in the form of POST /jobs"),
          output_only(
              "duration_s",
              [](const View& plan) { return plan.motion.timed.trajectory->duration(); },
              seconds(kPositive)),
          output_only("length", &View::length, number({0.0}),
                      "Length of the path in joint space, rad or m"),
          output_only("straight_line_length", &View::straight_line_length, number({0.0}),
                      "Length of the straight line to the goal in joint space"),
          output_only(
              "evaluations", [](const View& plan) { return plan.motion.way.evaluations; }, count(),
              "Line segments checked by the search"),
          output_if(
              "verdict",
              [](const View& plan) {
                return plan.verdict ? std::optional(*plan.verdict) : std::nullopt;
              },
              verdict_format(), "Result of POST /check for this motion now"),
          output_if(
              "not_checked_reason",
              [](const View& plan) {
                return plan.verdict ? std::nullopt
                                    : std::optional(document_of(plan.verdict.error()));
              },
              problem_format(),
              "Instead of `verdict`: why POST /jobs would refuse this motion now"),
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
    document.detail += ": increase `budget` or try another `seed`";
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

#include <utility>

#include "server/api/route.h"
#include "server/messages/plan.h"
#include "server/messages/steps_plan.h"

namespace armloom {
namespace {

Response refusal(const ProblemDocument& why) {
  Response refused = answer(why.status, problem_format(), why);
  refused.content_type = "application/problem+json";
  return refused;
}

Response plan_response(const Result<PlanOutcome>& result, const Cell&) {
  if (!result) return problem_response(result.error());
  if (*result) return answer(200, plan_format(), **result);
  return refusal(document_of(result->error()));
}

Response plan_response(const Result<StepsPlan>& result, const Cell& cell) {
  if (!result) return problem_response(result.error());
  const bool is_refused = !std::holds_alternative<std::monostate>(result->refused);
  if (is_refused) return refusal(document_of(*result, cell));
  return answer(200, steps_plan_format(), answer_of(*result, cell));
}

// Plans a motion, or the motions of a job with steps. If the client disconnects (`gone`), the plan
// is dropped.
void post_plan(Call call) {
  const auto plan = [&parts = call.parts, respond = call.respond,
                     gone = call.request.gone](PlanBody read) {
    const auto body = std::make_shared<PlanBody>(std::move(read));
    parts.loop.post([&parts, body, respond, gone](Executive& executive) {
      const auto done = [&parts, respond](auto result) {
        parts.post([&parts, respond, result = std::move(result)] {
          respond(plan_response(result, *parts.cell));
        });
      };
      std::visit([&](auto& inquiry) { executive.inquiries().plan(std::move(inquiry), gone, done); },
                 *body);
    });
  };
  read_body(call.parts, call.request, call.respond, read_plan_body_text, plan);
}

Outcome planned_outcome() {
  const Schema either =
      Schema::array({plan_format()->schema(Way::out), steps_plan_format()->schema(Way::out)});
  return {200,
          "The planned motion, and the verdict that it would get as a job; of a job with steps: "
          "its steps with their planned motions",
          {{"application/json", {{"anyOf", either}}}}};
}

}  // namespace

std::vector<Route> plan_routes() {
  return {
      {.method = "POST",
       .path = api_path("/plan"),
       .id = "planMotion",
       .tag = "jobs",
       .summary = "Plan a motion to a goal without executing it",
       .text = "Plans a motion around everything at rest, and around the arms at their predicted "
               "end positions. The motion is certified collision-free over its whole duration. If "
               "there is no plan, the problem's type ends with the reason: start-in-collision, "
               "goal-in-collision, goal-not-reached, outside-limits, not-found, line-broken or "
               "line-blocked. Of a job with `steps`, all motions are planned in order: each from "
               "where the step before it ends, with what the arms then hold. If a step cannot be "
               "planned, the problem's pointer names it, and `steps` has the steps before it.",
       .reads = body(plan_body_format(),
                     {{"named", R"({"arm": "left", "to": {"named": "ready"}})"},
                      {"pose", R"({"arm": "left", "to": {"pose": {"link": "left_panda_link8", )"
                               R"("xyz": [0, 0.2, 0.5], "rpy": [3.14, 0, 0]}}, "seed": 7})"},
                      {"steps", R"({"arm": "left", "steps": [{"move_to": {"named": "ready"}}, )"
                                R"({"move_to": {"named": "home"}}]})"}}),
       .outcomes = {planned_outcome()},
       .refuses = {409, 422},
       .who = Who::commander,
       .run = post_plan},
  };
}

}  // namespace armloom

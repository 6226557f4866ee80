#include <utility>

#include "server/api/route.h"
#include "server/messages/plan.h"

namespace armloom {
namespace {

Response plan_response(const Result<PlanOutcome>& result) {
  if (!result) return problem_response(result.error());
  if (*result) return answer(200, plan_format(), **result);
  const ProblemDocument why = document_of(result->error());
  Response refused = answer(why.status, problem_format(), why);
  refused.content_type = "application/problem+json";
  return refused;
}

// Plans a motion. If the client disconnects (`gone`), the plan is dropped.
void post_plan(Call call) {
  const auto plan = [&parts = call.parts, respond = call.respond,
                     gone = call.request.gone](PlanInquiry read) {
    const auto inquiry = std::make_shared<PlanInquiry>(std::move(read));
    parts.loop.post([&parts, inquiry, respond, gone](Executive& executive) {
      executive.plan(std::move(*inquiry), gone, [&parts, respond](Result<PlanOutcome> result) {
        parts.post([respond, result = std::move(result)] { respond(plan_response(result)); });
      });
    });
  };
  read_body(call.parts, call.request, call.respond, read_plan_inquiry_text, plan);
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
               "line-blocked.",
       .reads = body(plan_inquiry_format(),
                     {{"named", R"({"arm": "left", "to": {"named": "ready"}})"},
                      {"pose", R"({"arm": "left", "to": {"pose": {"link": "left_panda_link8", )"
                               R"("xyz": [0, 0.2, 0.5], "rpy": [3.14, 0, 0]}}, "seed": 7})"}}),
       .outcomes = {outcome(200, "The planned motion, and the verdict that it would get as a job",
                            plan_format())},
       .refuses = {422},
       .who = Who::commander,
       .run = post_plan},
  };
}

}  // namespace armloom

#include <memory>
#include <utility>

#include "core/executive/active_policy.h"
#include "server/api/route.h"
#include "server/comparison/comparison.h"

namespace armloom {
namespace {

Response view_response(int status, const ComparisonView& view) {
  return answer(status, comparison_format(), view);
}

void post_comparison(Call call) {
  const ApiParts& parts = call.parts;
  const auto start = [&parts, respond = call.respond](const ComparisonInquiry& inquiry) {
    struct AsItIs {
      std::vector<CollisionObject> objects;
      std::string policy;
    };
    ask(
        parts,
        [](Executive& executive) {
          return AsItIs{executive.scene().objects(), executive.policy().name()};
        },
        [&parts, inquiry, respond](AsItIs& as_it_is) {
          auto started =
              parts.comparison.start({inquiry, parts.at_hand->since(inquiry.since),
                                      std::move(as_it_is.objects), std::move(as_it_is.policy)});
          respond(started ? view_response(202, *started) : problem_response(started.error()));
        });
  };
  read_body(parts, call.request, call.respond, read_comparison_inquiry, start);
}

Response nothing_compared() {
  return refusal_response({404, "not-found",
                           "no comparison exists: start one with POST /comparison",
                           "request target", api_path("/comparison")});
}

void get_comparison(Call call) {
  const auto& latest = call.parts.comparison.latest();
  call.respond(latest ? view_response(200, *latest) : nothing_compared());
}

void cancel_comparison(Call call) {
  Comparison& comparison = call.parts.comparison;
  comparison.cancel();
  const auto& latest = comparison.latest();
  call.respond(latest ? view_response(200, *latest) : nothing_compared());
}

}  // namespace

std::vector<Route> comparison_routes() {
  Route post{.method = "POST",
             .path = api_path("/comparison"),
             .id = "comparePolicies",
             .tag = "cell",
             .summary = "Simulate the submitted jobs under several policies"};
  post.text =
      "Simulates the jobs submitted since the server started, at most the last 500 jobs or 16 MiB. "
      "Each job is submitted at its original time, with the present scene and without cancels, "
      "stops and faults. If older jobs are left out, each arm begins at the start of its first "
      "trajectory. The cell is not affected. One comparison runs at a time; GET returns its "
      "progress.";
  post.reads = body(comparison_inquiry_format(),
                    {{"all", "{}"}, {"two", R"({"policies": ["sequential", "coordinated"]})"}});
  post.outcomes = {outcome(202, "The comparison has started", comparison_format())};
  post.refuses = {409, 422};
  post.who = Who::commander;
  post.role = Role::operate;
  post.run = post_comparison;
  Route get{.method = "GET",
            .path = api_path("/comparison"),
            .id = "getComparison",
            .tag = "cell",
            .summary = "Get the progress and the results of the comparison"};
  get.outcomes = {outcome(200, "The running or the latest comparison", comparison_format())};
  get.refuses = {404};
  get.run = get_comparison;
  Route cancel{.method = "DELETE",
               .path = api_path("/comparison"),
               .id = "cancelComparison",
               .tag = "cell",
               .summary = "Cancel the running comparison"};
  cancel.text = "Keeps the results of policies that were simulated completely.";
  cancel.outcomes = {outcome(200, "The canceled comparison, or the last one if none is running",
                             comparison_format())};
  cancel.refuses = {404};
  cancel.who = Who::commander;
  cancel.role = Role::operate;
  cancel.run = cancel_comparison;
  return {post, get, cancel};
}

}  // namespace armloom

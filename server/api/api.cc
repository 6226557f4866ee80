#include "server/api/api.h"

#include <utility>

#include "core/executive/status_board.h"
#include "server/api/answer_form.h"
#include "server/api/route.h"

namespace armloom {
namespace {

Present present(const Status& status, const Cell& cell) {
  Present now{to_seconds(status.time), {}};
  for (std::uint32_t a = 0; a < status.arms.size(); ++a) {
    const ArmStatus& arm = status.arms[a];
    if (const auto job = arm.job ? status.jobs.find(*arm.job) : nullptr) {
      if (job->motion.ends_at_rest) now.ending.push_back(job->key);
    }
    const bool has_connected = arm.link != ArmLink::State::connecting;
    if (has_connected && arm.link != ArmLink::State::lost) continue;
    now.unlinked.push_back({cell.arm(ArmId{a}).name, has_connected, arm.link_detail});
  }
  return now;
}

// Returns the faults of the query, and of a body that a command does not read. (A GET may have a
// body, which means nothing.)
Problems faults_of(const Request& request, const Route& route,
                   const std::vector<std::string>& parameters) {
  Problems faults;
  if (auto fault = query_problem(request.target, parameters)) faults.push_back(std::move(*fault));
  if (auto fault = bad_pretty(request.target)) faults.push_back(std::move(*fault));
  // The body of a stop is not read (read_request()).
  const bool has_body = route.is_stop ? request.has_body : !request.body->empty();
  if (has_body && !route.reads && route.method != "GET") {
    const std::string& instead = route.instead_of_body;
    faults.push_back(
        {ProblemKind::malformed,
         "unexpected-body",
         "request body",
         "this request has no body: remove it" + (instead.empty() ? "" : "; " + instead),
         {}});
  }
  return faults;
}

}  // namespace

// Adds the answer's text for people.
Respond Api::with_text(const Route& route, Respond respond) const {
  return [this, as_text = route.as_text, respond = std::move(respond)](Response response) {
    if (response.status < 300) {
      response.as_text = [as_text, now = present(parts_.loop.board().read(), *parts_.cell)](
                             std::string_view json) { return as_text(Schema::parse(json), now); };
    }
    respond(std::move(response));
  };
}

void Api::add_routes(Router& router) {
  for (const Route& route : all_routes()) {
    if (route.run == nullptr) continue;
    std::vector<std::string> parameters;
    for (const Parameter& parameter : route.parameters) {
      if (std::string_view(parameter.in) == "query") parameters.push_back(parameter.name);
    }
    if (route.answers_json()) parameters.emplace_back(kPretty);
    router.add(
        route.method, route.path, route.rights(),
        [this, &route, parameters](const Request& request, const Router::Arguments& arguments,
                                   Respond respond) {
          auto faults = faults_of(request, route, parameters);
          if (!route.is_stop && !faults.empty()) return respond(problem_response(faults));
          if (route.as_text != nullptr) respond = with_text(route, std::move(respond));
          route.run(Call{parts_, meshes_, recordings_, request, arguments, std::move(faults),
                         std::move(respond)});
        },
        parameters);
  }
}

}  // namespace armloom

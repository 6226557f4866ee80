#include "server/api/answers.h"

#include <utility>

#include "server/messages/mesh_address.h"
#include "server/messages/problem.h"

namespace armloom {
namespace {

Response of_problem(int status, std::string body) {
  return Response{
      status, "application/problem+json", std::move(body) + '\n', {{"Cache-Control", "no-store"}}};
}

}  // namespace

Response json_response(int status, std::string body) {
  return Response{
      status, "application/json", std::move(body) + '\n', {{"Cache-Control", "no-store"}}};
}

Response problem_response(const Problems& problems) {
  return of_problem(status_of(problems.front().kind), problem_json(problems));
}

Response refusal_response(const Refusal& refusal) {
  ProblemDocument document{problem_type(refusal.slug),
                           problem_title(refusal.slug),
                           refusal.status,
                           refusal.detail,
                           refusal.pointer,
                           std::nullopt,
                           {}};
  if (refusal.value) document.value = *refusal.value;
  Response response = of_problem(refusal.status, text_of(*problem_format(), document));
  response.headers.insert(response.headers.end(), refusal.headers.begin(), refusal.headers.end());
  return response;
}

Response done_but_not_stored(Refusal refusal) {
  refusal.detail =
      "done, but not stored, so the server may not know of this change after a restart: " +
      refusal.detail;
  return refusal_response(refusal);
}

std::function<void(std::optional<Refusal>)> when_stored(Respond respond, Response response) {
  return [respond = std::move(respond),
          response = std::move(response)](std::optional<Refusal> refusal) {
    respond(refusal ? done_but_not_stored(*std::move(refusal)) : response);
  };
}

Response no_such(const char* what, const std::string& name) {
  return problem_response(
      {Problem{ProblemKind::not_found, std::string("no-such-") + what, "request target",
               std::string("no such ") + what + " \"" + name + "\"", name}});
}

Response located(Response response, const std::string& path) {
  response.headers.emplace_back("Location", kApiPrefix + path);
  return response;
}

}  // namespace armloom

#include "server/http/router.h"

#include <optional>
#include <utility>

namespace armloom {
namespace {

std::vector<std::string> segments_of(std::string_view path) {
  std::vector<std::string> segments;
  path.remove_prefix(1);
  for (;;) {
    const std::size_t slash = path.find('/');
    segments.emplace_back(path.substr(0, slash));
    if (slash == path.npos) return segments;
    path.remove_prefix(slash + 1);
  }
}

std::optional<Router::Arguments> match(const std::vector<std::string>& pattern,
                                       const std::vector<std::string>& path) {
  if (pattern.size() != path.size()) return std::nullopt;
  Router::Arguments arguments;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (pattern[i] == "{}" && !path[i].empty()) {
      arguments.push_back(path[i]);
    } else if (pattern[i] != path[i]) {
      return std::nullopt;
    }
  }
  return arguments;
}

}  // namespace

void Router::add(std::string method, std::string_view pattern, Answer answer,
                 std::vector<std::string> parameters) {
  routes_.push_back(
      Route{std::move(method), segments_of(pattern), std::move(answer), std::move(parameters)});
}

std::vector<std::string> Router::routes() const {
  std::vector<std::string> names;
  for (const Route& route : routes_) {
    std::string name = route.method + " ";
    for (const std::string& segment : route.segments) name += "/" + segment;
    names.push_back(std::move(name));
  }
  return names;
}

void Router::dispatch(const Request& request, Respond respond) const {
  const std::vector<std::string> path = segments_of(request.target.path);
  std::string allow;
  for (const Route& route : routes_) {
    const auto arguments = match(route.segments, path);
    if (!arguments) continue;
    if (route.method == request.method) {
      if (auto unknown = unknown_parameter(request.target, route.parameters)) {
        return respond(problem_response({std::move(*unknown)}));
      }
      return route.answer(request, *arguments, respond);
    }
    allow += (allow.empty() ? "" : ", ") + route.method + (route.method == "GET" ? ", HEAD" : "");
  }
  if (!allow.empty()) {
    Response refused =
        http_problem(405, "method-not-allowed",
                     request.method + " is not served here; allowed: " + allow, request.method);
    refused.headers.emplace_back("Allow", allow);
    return respond(std::move(refused));
  }
  if (otherwise_) return otherwise_(request, {}, respond);
  respond(problem_response(
      {Problem{ProblemKind::not_found, "not-found", "request target",
               "nothing is served at " + request.target.path, request.target.path}}));
}

}  // namespace armloom

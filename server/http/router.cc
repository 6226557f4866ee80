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
    if (pattern[i].starts_with('{') && !path[i].empty()) {
      arguments.push_back(path[i]);
    } else if (pattern[i] != path[i]) {
      return std::nullopt;
    }
  }
  return arguments;
}

}  // namespace

void Router::add(std::string method, std::string_view pattern, Who who, Answer answer,
                 std::vector<std::string> parameters) {
  routes_.push_back(Route{std::move(method), segments_of(pattern), who, std::move(answer),
                          std::move(parameters)});
}

std::string Router::allowed_at(const std::vector<std::string>& path) const {
  std::string allow;
  for (const Route& route : routes_) {
    if (!match(route.segments, path)) continue;
    allow += (allow.empty() ? "" : ", ") + route.method + (route.method == "GET" ? ", HEAD" : "");
  }
  return allow;
}

void Router::dispatch(const Request& request, Respond respond) const {
  const std::vector<std::string> path = segments_of(request.target.path);
  for (const Route& route : routes_) {
    if (route.method != request.method) continue;
    const auto arguments = match(route.segments, path);
    if (!arguments) continue;
    if (route.who == Who::own && request.foreign) return respond(refuse_(*request.foreign));
    if (const auto unknown = unknown_parameter(request.target, route.parameters)) {
      return respond(refuse_(refusal_of(400, *unknown)));
    }
    return route.answer(request, *arguments, respond);
  }
  if (request.foreign && request.method != "GET") return respond(refuse_(*request.foreign));
  const std::string allow = allowed_at(path);
  if (!allow.empty()) {
    return respond(refuse_({405,
                            "method-not-allowed",
                            request.method + " is not served here; allowed: " + allow,
                            std::nullopt,
                            request.method,
                            {{"Allow", allow}}}));
  }
  if (otherwise_) return otherwise_(request, {}, respond);
  respond(refuse_({404, "not-found", "nothing is served at " + request.target.path,
                   "request target", request.target.path}));
}

}  // namespace armloom

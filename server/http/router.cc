#include "server/http/router.h"

#include <optional>
#include <set>
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

// Answers OPTIONS, including CORS preflight requests.
Response options_of(const Request& request, const std::string& allow) {
  Response response{204, "", "", {{"Allow", allow}}};
  if (!request.cross_origin) return response;
  response.headers.emplace_back("Access-Control-Allow-Methods", allow);
  response.headers.emplace_back(
      "Access-Control-Allow-Headers",
      "Authorization, Content-Type, Idempotency-Key, If-Match, If-None-Match, Last-Event-ID");
  response.headers.emplace_back("Access-Control-Max-Age", "600");
  return response;
}

}  // namespace

void Router::add(std::string method, std::string_view pattern, Rights rights, Answer answer,
                 std::vector<std::string> parameters) {
  routes_.push_back(Route{std::move(method), std::string(pattern), segments_of(pattern), rights,
                          std::move(answer), std::move(parameters)});
}

// Returns the methods served at the path, or at any path for "*". GET implies HEAD, and any method
// implies OPTIONS. Returns "" if there are none.
std::string Router::allowed_at(const std::string& path) const {
  std::set<std::string> methods;
  const bool everywhere = path == "*";
  const auto segments = everywhere ? std::vector<std::string>{} : segments_of(path);
  for (const Route& route : routes_) {
    if (!everywhere && !match(route.segments, segments)) continue;
    methods.insert(route.method);
    if (route.method == "GET") methods.insert("HEAD");
  }
  if (methods.empty()) return "";
  methods.insert("OPTIONS");
  std::string allow;
  for (const std::string& method : methods) allow += (allow.empty() ? "" : ", ") + method;
  return allow;
}

Router::Found Router::find(const Request& request) const {
  if (request.method == "OPTIONS") return {};
  const std::vector<std::string> path = segments_of(request.target.path);
  for (const Route& route : routes_) {
    if (route.method != request.method) continue;
    if (auto arguments = match(route.segments, path)) return {&route, std::move(*arguments)};
  }
  return {};
}

std::optional<Response> Router::refusal(const Request& request, const Found& found) const {
  const Rights unrouted{request.method == "GET" ? Who::reader : Who::commander, std::nullopt,
                        false};
  const auto [who, role, is_stop] = found.route != nullptr ? found.route->rights : unrouted;
  if (who != Who::anyone && request.stranger) return refuse_(*request.stranger);
  if (who == Who::commander && request.foreign) return refuse_(*request.foreign);
  if (role && guard_) {
    if (const auto why = guard_(request, *role)) return refuse_(*why);
  }
  if (is_stop) return std::nullopt;
  const auto fault = found.route != nullptr ? query_problem(request.target, found.route->parameters)
                                            : request.target.query_fault;
  if (fault) return refuse_(refusal_of(400, *fault));
  if (found.route != nullptr) return std::nullopt;
  const std::string allow = allowed_at(request.target.path);
  if (allow.empty()) return std::nullopt;
  if (request.method == "OPTIONS") return options_of(request, allow);
  return refuse_({405,
                  "method-not-allowed",
                  request.method + " is not served here; allowed: " + allow,
                  std::nullopt,
                  request.method,
                  {{"Allow", allow}}});
}

Response Router::unrouted(const Request& request) const {
  if (otherwise_) return otherwise_(request);
  return refuse_({404, "not-found", "nothing is served at " + request.target.path, "request target",
                  request.target.path});
}

std::optional<Response> Router::refuse_unread(const Request& request) const {
  const Found found = find(request);
  auto refused = refusal(request, found);
  return refused || found.route != nullptr ? std::move(refused) : unrouted(request);
}

void Router::dispatch(const Request& request, Respond respond) const {
  const Found found = find(request);
  if (watch_) {
    respond = [this, method = request.method, route = found.route, inner = std::move(respond),
               asked = std::chrono::steady_clock::now()](Response response) {
      watch_(method, route == nullptr ? "" : route->pattern, response.status,
             std::chrono::steady_clock::now() - asked);
      inner(std::move(response));
    };
  }
  if (limit_ && is_counted(found)) {
    if (const auto why = limit_(request)) return respond(refuse_(*why));
  }
  if (auto refused = refusal(request, found)) return respond(std::move(*refused));
  if (found.route == nullptr) return respond(unrouted(request));
  found.route->answer(request, found.arguments, std::move(respond));
}

}  // namespace armloom

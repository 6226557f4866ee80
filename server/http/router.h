#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/role.h"
#include "server/http/message.h"

namespace armloom {

// Clients that a route serves.
// - anyone: any Host, and no rate limit (probes);
// - reader: an allowed Host; also pages of other sites, but browsers hide the response from them;
// - commander: an allowed Host, and no Origin of another site unless it is allowed.
enum class Who { anyone, reader, commander };

// The clients that a route serves, and the role that their token must have. `role` is nullopt if no
// token is needed. A route that stops arms is exempt from limits, and it gets requests with a bad
// query: it stops the arms before it reports the fault.
struct Rights {
  Who who = Who::reader;
  std::optional<Role> role = Role::viewer;
  bool is_stop = false;

  // Returns true if the rate limit applies to the request.
  [[nodiscard]] bool is_counted() const { return !is_stop && who != Who::anyone; }
};

// Maps method and path to a handler. In a pattern, {id} stands for any one non-empty segment:
// "/jobs/{id}".
class Router {
 public:
  // Values of the {...} segments, in order.
  using Arguments = std::vector<std::string>;
  using Answer = std::function<void(const Request&, const Arguments&, Respond)>;

  explicit Router(WriteRefusal refuse) : refuse_(std::move(refuse)) {}

  // `parameters`: allowed query parameters. A stop checks its query itself.
  void add(std::string method, std::string_view pattern, Rights rights, Answer answer,
           std::vector<std::string> parameters = {});
  // Called for every response of dispatch(), with the method, the route's pattern ("" without a
  // route), the status and the duration.
  using Watch =
      std::function<void(const std::string&, const std::string&, int, std::chrono::nanoseconds)>;
  void watch(Watch watch) { watch_ = std::move(watch); }
  // Returns a refusal if the client lacks the role, else nullopt. Without a guard, every client has
  // every role.
  using Guard = std::function<std::optional<Refusal>(const Request&, Role)>;
  void guard(Guard guard) { guard_ = std::move(guard); }
  // Returns a refusal if the request exceeds a limit, else nullopt. Called before any other check.
  using Limit = std::function<std::optional<Refusal>(const Request&)>;
  void limit(Limit limit) { limit_ = std::move(limit); }
  // Sets the function that answers requests whose path matches no pattern (the dashboard's files).
  // It may be called before the body is read.
  void otherwise(std::function<Response(const Request&)> answer) { otherwise_ = std::move(answer); }

  // Answers with the first of these that applies:
  // - the refusal of the limit
  // - 403 if Host or Origin is not allowed
  // - the refusal of the guard
  // - 400 if the query is broken or has a parameter that the route does not know, except for stops
  // - if a route matches: the route's answer
  // - if routes with other methods match: 204 with Allow for OPTIONS, else 405 with Allow
  // - the answer of otherwise(), or 404 if it is not set
  void dispatch(const Request& request, Respond respond) const;
  // Returns the response of dispatch() if it does not depend on the body, else nullopt. Does not
  // apply the limit.
  [[nodiscard]] std::optional<Response> refuse_unread(const Request& request) const;
  [[nodiscard]] bool is_stop(const Request& request) const { return is_stop(find(request)); }

 private:
  struct Route {
    std::string method;
    std::string pattern;
    std::vector<std::string> segments;
    Rights rights;
    Answer answer;
    std::vector<std::string> parameters;
  };
  struct Found {
    const Route* route = nullptr;
    Arguments arguments;
  };
  [[nodiscard]] Found find(const Request& request) const;
  [[nodiscard]] static bool is_stop(const Found& found) {
    return found.route != nullptr && found.route->rights.is_stop;
  }
  [[nodiscard]] static bool is_counted(const Found& found) {
    return found.route == nullptr || found.route->rights.is_counted();
  }
  [[nodiscard]] std::string allowed_at(const std::string& path) const;
  [[nodiscard]] std::optional<Response> refusal(const Request& request, const Found& found) const;
  [[nodiscard]] Response unrouted(const Request& request) const;

  WriteRefusal refuse_;
  std::vector<Route> routes_;
  Watch watch_;
  Guard guard_;
  Limit limit_;
  std::function<Response(const Request&)> otherwise_;
};

}  // namespace armloom

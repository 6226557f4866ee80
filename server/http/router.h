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

// Whose requests are served. Anyone's, by whatever name they come, and however much else comes from
// there: probes. Readers': those that come by a name that is the server's, pages of other sites
// among them (a browser does not show them the answer). Commanders': of those, the site's own
// pages, and programs.
enum class Who { anyone, reader, commander };

// Whose requests a route serves, and what the token that they show has to allow. No role: none is
// needed.
struct Rights {
  Who who = Who::reader;
  std::optional<Role> role = Role::viewer;
  bool is_never_limited = false;

  // Among the requests that its client may ask so many of.
  [[nodiscard]] bool is_counted() const { return !is_never_limited && who != Who::anyone; }
};

// Which function answers which method and path. A pattern is a path in which {id} stands for any
// one non-empty segment: "/jobs/{id}".
class Router {
 public:
  // What the {...} stood for, in order.
  using Arguments = std::vector<std::string>;
  using Answer = std::function<void(const Request&, const Arguments&, Respond)>;

  explicit Router(WriteRefusal refuse) : refuse_(std::move(refuse)) {}

  // `parameters`: those that the query may have.
  void add(std::string method, std::string_view pattern, Rights rights, Answer answer,
           std::vector<std::string> parameters = {});
  // Is told of every answer that dispatch() gives: method, the pattern that fits ("": none),
  // status, and how long it took.
  using Watch =
      std::function<void(const std::string&, const std::string&, int, std::chrono::nanoseconds)>;
  void watch(Watch watch) { watch_ = std::move(watch); }
  // Says why whoever asks lacks a role; absent: they have it. Without a guard everyone has each.
  using Guard = std::function<std::optional<Refusal>(const Request&, Role)>;
  void guard(Guard guard) { guard_ = std::move(guard); }
  // Says why this request is one too many; absent: it is not. Asked before anything else.
  using Limit = std::function<std::optional<Refusal>(const Request&)>;
  void limit(Limit limit) { limit_ = std::move(limit); }
  // Answers requests for paths that no pattern fits (the dashboard's files), without their bodies.
  void otherwise(std::function<Response(const Request&)> answer) { otherwise_ = std::move(answer); }

  // What the limit says, 403 when a stranger, or a foreign page, asks for what is not for such,
  // what the guard says, 400 when the query has an unknown parameter (not for what otherwise()
  // answers), 404 when nothing fits the path, 405 with Allow when only the method does not fit.
  // OPTIONS is answered here: 204 with Allow.
  void dispatch(const Request& request, Respond respond) const;
  // What dispatch() will answer whatever the body says; absent: a route's function answers.
  [[nodiscard]] std::optional<Response> refuse_unread(const Request& request) const;
  [[nodiscard]] bool is_never_limited(const Request& request) const {
    return is_never_limited(find(request));
  }

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
  [[nodiscard]] static bool is_never_limited(const Found& found) {
    return found.route != nullptr && found.route->rights.is_never_limited;
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

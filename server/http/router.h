#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace armloom {

// Which function answers which method and path. A pattern is a path in which {} stands for any one
// non-empty segment: "/api/v1/jobs/{}".
class Router {
 public:
  // What the {} stood for, in order.
  using Arguments = std::vector<std::string>;
  using Answer = std::function<void(const Request&, const Arguments&, Respond)>;

  // `parameters`: those that the query may have.
  void add(std::string method, std::string_view pattern, Answer answer,
           std::vector<std::string> parameters = {});
  // Answers requests for paths that no pattern fits (the dashboard's files).
  void otherwise(Answer answer) { otherwise_ = std::move(answer); }

  // "GET /api/v1/jobs/{}", in the order in which they were added.
  [[nodiscard]] std::vector<std::string> routes() const;

  // 400 when the query has an unknown parameter (not for what otherwise() answers), 404 when
  // nothing fits the path, 405 with Allow when only the method does not fit.
  void dispatch(const Request& request, Respond respond) const;

 private:
  struct Route {
    std::string method;
    std::vector<std::string> segments;
    Answer answer;
    std::vector<std::string> parameters;
  };
  std::vector<Route> routes_;
  Answer otherwise_;
};

}  // namespace armloom

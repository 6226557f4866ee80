#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/http/message.h"

namespace armloom {

// Whose requests are served: everybody's, or only commands of the site's own pages and of programs.
enum class Who { anyone, own };

// Which function answers which method and path. A pattern is a path in which {id} stands for any
// one non-empty segment: "/jobs/{id}".
class Router {
 public:
  // What the {...} stood for, in order.
  using Arguments = std::vector<std::string>;
  using Answer = std::function<void(const Request&, const Arguments&, Respond)>;

  explicit Router(WriteRefusal refuse) : refuse_(std::move(refuse)) {}

  // `parameters`: those that the query may have.
  void add(std::string method, std::string_view pattern, Who who, Answer answer,
           std::vector<std::string> parameters = {});
  // Answers requests for paths that no pattern fits (the dashboard's files).
  void otherwise(Answer answer) { otherwise_ = std::move(answer); }

  // 403 when a foreign page asks for what is not for anyone, 400 when the query has an unknown
  // parameter (not for what otherwise() answers), 404 when nothing fits the path, 405 with Allow
  // when only the method does not fit.
  void dispatch(const Request& request, Respond respond) const;

 private:
  struct Route {
    std::string method;
    std::vector<std::string> segments;
    Who who;
    Answer answer;
    std::vector<std::string> parameters;
  };
  [[nodiscard]] std::string allowed_at(const std::vector<std::string>& path) const;

  WriteRefusal refuse_;
  std::vector<Route> routes_;
  Answer otherwise_;
};

}  // namespace armloom

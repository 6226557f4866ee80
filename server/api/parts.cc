#include "server/api/parts.h"

#include <algorithm>

namespace armloom {

Result<void> check_content_type(const Request& request) {
  const std::string found = request.content_type.value_or("none");
  std::string media = found.substr(0, found.find(';'));
  media.erase(std::remove(media.begin(), media.end(), ' '), media.end());
  std::transform(media.begin(), media.end(), media.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (media == "application/json") return {};
  return failure(Problem{ProblemKind::unsupported, "unsupported-media-type", "Content-Type",
                         "the body must be application/json, found " + found, found});
}

Response no_such(const char* what, const std::string& name) {
  return problem_response(
      {Problem{ProblemKind::not_found, std::string("no-such-") + what, "request target",
               std::string("there is no ") + what + " \"" + name + "\"", name}});
}

}  // namespace armloom

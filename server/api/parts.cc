#include "server/api/parts.h"

#include <algorithm>

namespace armloom {

namespace {

std::string small(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '"'; });
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

tl::unexpected<Problems> unsupported(const char* slug, const char* field, std::string detail,
                                     const std::string& found) {
  return failure(Problem{ProblemKind::unsupported, slug, field,
                         std::move(detail) + ", found " + found, found});
}

}  // namespace

Result<void> check_content_type(const Request& request) {
  const std::string found = request.content_type.value_or("none");
  const std::string type = small(found);
  if (type.substr(0, type.find(';')) != "application/json") {
    return unsupported("unsupported-media-type", "Content-Type",
                       "the body must be application/json", found);
  }
  for (std::size_t at = type.find(';'); at != type.npos;) {
    const std::size_t end = type.find(';', at + 1);
    const std::string parameter = type.substr(at + 1, end == type.npos ? end : end - at - 1);
    if (parameter.starts_with("charset=") && parameter != "charset=utf-8") {
      return unsupported("unsupported-charset", "Content-Type", "JSON must be in UTF-8", found);
    }
    at = end;
  }
  const std::string encoding = request.content_encoding.value_or("identity");
  if (small(encoding) != "identity") {
    return unsupported("unsupported-encoding", "Content-Encoding",
                       "the body must come as it is (identity)", encoding);
  }
  return {};
}

Response no_such(const char* what, const std::string& name) {
  return problem_response(
      {Problem{ProblemKind::not_found, std::string("no-such-") + what, "request target",
               std::string("there is no ") + what + " \"" + name + "\"", name}});
}

}  // namespace armloom

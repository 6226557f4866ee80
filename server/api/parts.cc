#include "server/api/parts.h"

#include <algorithm>
#include <chrono>
#include <sstream>

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

std::optional<Refusal> refusal_of_store(const ApiParts& parts) {
  return parts.keeper != nullptr ? parts.keeper->refusal() : std::nullopt;
}

bool is_limited(const ApiParts& parts, const std::string& client, std::size_t jobs,
                const Respond& respond) {
  const auto refusal = parts.limits.jobs(client, jobs, std::chrono::steady_clock::now());
  if (!refusal) return false;
  parts.metrics.limited("jobs");
  respond(refusal_response(*refusal));
  return true;
}

Result<BodyForm> body_form(const Request& request) {
  const std::string found = request.content_type.value_or("none");
  std::istringstream parts(small(found));
  std::string part;
  std::getline(parts, part, ';');
  const bool is_yaml =
      part == "application/yaml" || part == "application/x-yaml" || part == "text/yaml";
  if (part != "application/json" && !is_yaml) {
    return unsupported("unsupported-media-type", "Content-Type",
                       "the body must be application/json or application/yaml (with curl: "
                       "-H 'Content-Type: application/json')",
                       found);
  }
  while (std::getline(parts, part, ';')) {
    if (part.starts_with("charset=") && part != "charset=utf-8") {
      return unsupported("unsupported-charset", "Content-Type", "the body must be in UTF-8", found);
    }
  }
  const std::string encoding = request.content_encoding.value_or("identity");
  if (small(encoding) != "identity") {
    return unsupported("unsupported-encoding", "Content-Encoding",
                       "the body must not be encoded: Content-Encoding must be identity or absent",
                       encoding);
  }
  return is_yaml ? BodyForm::yaml : BodyForm::json;
}

}  // namespace armloom

#include "server/api/parts.h"

#include <algorithm>
#include <chrono>
#include <sstream>

#include "core/base/nearest_name.h"
#include "core/executive/status_board.h"

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

namespace {

Response no_such(const char* what, const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  const auto nearest = nearest_name(name, names);
  const std::string remedy = nearest ? "; did you mean " + std::string(*nearest) + "?"
                                     : std::string("; GET /") + what + "s lists them";
  return problem_response(
      {Problem{ProblemKind::not_found, std::string("no-such-") + what, "request target",
               std::string("no such ") + what + " \"" + name + "\"" + remedy, name}});
}

}  // namespace

Response no_such_job(const ApiParts& parts, const std::string& key) {
  constexpr std::size_t kCompared = 300;  // the newest; each comparison takes a microsecond
  std::vector<std::string> known;
  parts.loop.board().read().jobs.newest_first([&](const JobSheet::JobPtr& job) {
    known.push_back(job->key);
    return known.size() < kCompared;
  });
  return no_such("job", key, known);
}

Response no_such_arm(const ApiParts& parts, const std::string& name) {
  std::vector<std::string> known;
  for (const Arm& arm : parts.cell->arms) known.push_back(arm.name);
  return no_such("arm", name, known);
}

bool is_limited(const ApiParts& parts, const std::string& client, std::size_t jobs,
                const Respond& respond) {
  const auto refusal = parts.limits.jobs(client, jobs, std::chrono::steady_clock::now());
  if (!refusal) return false;
  parts.metrics.limited("jobs");
  respond(refusal_response(*refusal));
  return true;
}

void hint_at_yaml(Problems& problems) {
  Problem& first = problems.front();
  if (first.slug == "malformed-json" && first.detail.ends_with("this is not JSON")) {
    first.detail += "; for YAML, send the header Content-Type: application/yaml";
  }
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

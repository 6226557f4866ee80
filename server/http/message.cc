#include "server/http/message.h"

#include <algorithm>

#include "server/http/entity_tag.h"

namespace armloom {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> percent_decoded(std::string_view text, bool form) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+' && form) {
      out += ' ';
    } else if (text[i] != '%') {
      out += text[i];
    } else {
      const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
      if (high < 0 || low < 0) return std::nullopt;
      out += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return out;
}

Problem bad_target(std::string detail, std::string_view found) {
  return Problem{ProblemKind::malformed, "bad-target", "request target", std::move(detail),
                 std::string(found.substr(0, 200))};
}

Problem bad_parameter(const std::string& name, const std::string& value, std::string detail) {
  return Problem{ProblemKind::malformed, "bad-parameter", "?" + name, std::move(detail), value};
}

}  // namespace

Result<Target> parse_target(std::string_view text) {
  if (text.empty() || text.front() != '/') {
    return failure(bad_target("the request target must be an absolute path", text));
  }
  if (text.find('#') != text.npos) {
    return failure(bad_target("a request target has no fragment", text));
  }
  Target target;
  const std::size_t mark = text.find('?');
  const std::string_view raw_path = text.substr(0, mark);
  const auto path = percent_decoded(raw_path, false);
  if (!path) return failure(bad_target("a percent escape in the path is broken", raw_path));
  std::size_t slashes_raw = 0;
  std::size_t slashes = 0;
  for (const char c : raw_path) slashes_raw += c == '/' ? 1U : 0U;
  for (const char c : *path) slashes += c == '/' ? 1U : 0U;
  if (slashes != slashes_raw || path->find('\\') != path->npos || path->find('\0') != path->npos) {
    return failure(bad_target("the path contains an encoded slash, a backslash or NUL", raw_path));
  }
  target.path = *path;
  if (mark == text.npos) return target;

  std::string_view rest = text.substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(pair.size() == rest.size() ? rest.size() : pair.size() + 1);
    const std::size_t equals = pair.find('=');
    const auto name = percent_decoded(pair.substr(0, equals), true);
    const auto value =
        equals == pair.npos ? std::string() : percent_decoded(pair.substr(equals + 1), true);
    std::optional<Problem> fault;
    if (!name || !value) {
      fault = bad_target("a percent escape in the query is broken: send % as %25", pair);
    } else if (!name->empty() && !target.query.emplace(*name, *value).second) {
      fault = bad_parameter(*name, *value,
                            "the parameter \"" + *name + "\" occurs twice: send it once");
    }
    if (!target.query_fault) target.query_fault = std::move(fault);
  }
  return target;
}

std::optional<Problem> query_problem(const Target& target, const std::vector<std::string>& known) {
  if (target.query_fault) return target.query_fault;
  for (const auto& [name, value] : target.query) {
    if (std::ranges::find(known, name) != known.end()) continue;
    std::string names;
    for (const std::string& one : known) names += (names.empty() ? "" : ", ") + one;
    return bad_parameter(
        name, value,
        "unknown parameter \"" + name +
            (known.empty() ? "\"; no parameters are accepted here" : "\"; known: " + names));
  }
  return std::nullopt;
}

std::string url_segment(std::string_view text) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (letter || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~') {
      out += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      out += {'%', kHex[byte >> 4U], kHex[byte & 0xFU]};
    }
  }
  return out;
}

Refusal refusal_of(int status, const Problem& problem) {
  const auto* value = std::get_if<std::string>(&problem.value);
  return Refusal{status, problem.slug, problem.detail, problem.pointer,
                 value != nullptr ? std::optional(*value) : std::nullopt};
}

void vary_by(Response& response, std::string_view names) {
  const auto vary =
      std::ranges::find(response.headers, "Vary", &std::pair<std::string, std::string>::first);
  if (vary == response.headers.end()) {
    response.headers.emplace_back("Vary", names);
  } else {
    vary->second.append(", ").append(names);
  }
}

void answer_below_prefix(const Request& request, Response& response) {
  const auto location =
      std::ranges::find(response.headers, "Location", &std::pair<std::string, std::string>::first);
  if (location != response.headers.end() && location->second.starts_with('/')) {
    location->second.insert(0, request.prefix);
  }
}

void answer_across_origins(const Request& request, Response& response) {
  if (!request.cross_origin) return;
  response.headers.emplace_back("Access-Control-Allow-Origin", *request.cross_origin);
  response.headers.emplace_back("Access-Control-Expose-Headers",
                                "ETag, Location, Retry-After, X-Request-Id");
  vary_by(response, "Origin");
}

void answer_conditionally(const Request& request, Response& response) {
  if (!request.if_none_match || response.status != 200 || request.method != "GET") return;
  const auto tag =
      std::ranges::find(response.headers, "ETag", &std::pair<std::string, std::string>::first);
  if (tag == response.headers.end()) return;
  const auto strong = [](std::string_view text) {
    return text.starts_with("W/") ? text.substr(2) : text;
  };
  const bool matches = any_tag(*request.if_none_match, [&](std::string_view one) {
    return one == "*" || strong(one) == strong(tag->second);
  });
  if (!matches) return;
  response.status = 304;
  response.content_type.clear();
  response.body.clear();
  response.shared.reset();
  response.pieces.reset();
}

}  // namespace armloom

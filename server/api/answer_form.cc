#include "server/api/answer_form.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/codec/format.h"
#include "server/http/served_bytes.h"
#include "server/messages/plain_text.h"

namespace armloom {
namespace {

constexpr std::string_view kJsonType = "application/json";
constexpr std::string_view kProblemType = "application/problem+json";
constexpr int kFastLevel = 2;  // of gzip: JSON shrinks to a tenth even so

struct Form {
  bool pretty = false;
  bool text = false;
  bool gzip = false;
  [[nodiscard]] bool is_any() const { return pretty || text || gzip; }
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string_view cut(std::string_view& text, char at) {
  const std::string_view part = text.substr(0, text.find(at));
  text.remove_prefix(std::min(text.size(), part.size() + 1));
  return trimmed(part);
}

// Returns the weight that Accept gives to a media type, by its most specific range (RFC 9110,
// 12.5.1). `any` is the range of the type's first half: "text/*".
double weight_of(std::string_view accept, std::string_view type, std::string_view any) {
  std::array<double, 3> weights{-1.0, -1.0, -1.0};  // of */*, of text/*, of text/plain
  while (!accept.empty()) {
    std::string_view range = cut(accept, ',');
    const std::string_view name = cut(range, ';');
    double weight = 1.0;
    while (!range.empty()) {
      std::string_view value = cut(range, ';');
      if (cut(value, '=') == "q") {
        if (std::from_chars(value.data(), value.data() + value.size(), weight).ec != std::errc{}) {
          weight = 0.0;
        }
      }
    }
    if (name == "*/*") weights[0] = weight;
    if (name == any) weights[1] = weight;
    if (name == type) weights[2] = weight;
  }
  const auto found =
      std::find_if(weights.rbegin(), weights.rend(), [](double w) { return w >= 0; });
  return found == weights.rend() ? 0.0 : *found;
}

Form form_of(const Request& request) {
  const auto pretty = request.target.parameter(kPretty);
  return {.pretty = pretty && *pretty != "0",
          .text = weight_of(request.accept, "text/plain", "text/*") >
                  weight_of(request.accept, kJsonType, "application/*"),
          .gzip = accepts_gzip(request.accept_encoding)};
}

void extend_tag(Response& response, const char* by) {
  for (auto& [name, value] : response.headers) {
    if (name == "ETag") value.insert(value.size() - 1, by);
  }
}

void bring_into(const Form& form, Response& response) {
  const bool is_problem = response.content_type == kProblemType;
  if (form.text && (is_problem || response.as_text)) {
    response.body =
        is_problem ? problem_text(Schema::parse(response.body)) : response.as_text(response.body);
    response.content_type = "text/plain; charset=utf-8";
    extend_tag(response, "-text");
  } else if (form.pretty) {
    response.body = Schema::parse(response.body).dump(2) + '\n';
    extend_tag(response, "-pretty");
  }
  if (form.gzip && response.body.size() > kPackFrom) {
    response.body = gzipped(response.body, kFastLevel);
    response.headers.emplace_back("Content-Encoding", "gzip");
    extend_tag(response, "-gzip");
  }
}

}  // namespace

std::optional<Problem> bad_pretty(const Target& target) {
  const auto value = target.parameter(kPretty);
  if (!value || value->empty() || *value == "0" || *value == "1") return std::nullopt;
  return Problem{ProblemKind::malformed, "bad-parameter", "?pretty",
                 "pretty must be 1, 0 or without a value, found \"" + *value + "\"", *value};
}

Respond in_asked_form(const Request& request, Respond respond, RunTask aside, RunTask post) {
  return [form = form_of(request), respond = std::move(respond), aside = std::move(aside),
          post = std::move(post)](Response response) {
    const bool is_json =
        response.content_type == kJsonType || response.content_type == kProblemType;
    if (!is_json || response.body.empty()) return respond(std::move(response));
    vary_by(response, "Accept, Accept-Encoding");
    if (!form.is_any()) return respond(std::move(response));
    if (response.body.size() <= kPackFrom) {
      bring_into(form, response);
      return respond(std::move(response));
    }
    aside([form, respond, post, response = std::make_shared<Response>(std::move(response))] {
      bring_into(form, *response);
      post([respond, response] { respond(std::move(*response)); });
    });
  };
}

}  // namespace armloom

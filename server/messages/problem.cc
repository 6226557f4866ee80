#include "server/messages/problem.h"

#include <cctype>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/steps_plan.h"

namespace armloom {

using namespace formats;

namespace {

using Value = decltype(Problem::value);

class ValueFormat final : public CustomFormat<Value> {
 public:
  void read(const JsonNode&, Value&) const override {}
  void write(JsonWriter& out, const Value& value) const override {
    if (const auto* number = std::get_if<double>(&value)) {
      out.value(*number);
    } else if (const auto* text = std::get_if<std::string>(&value)) {
      out.value(*text);
    } else {
      out.value(nullptr);
    }
  }
  Schema schema(Way) const override { return {{"type", {"string", "number", "null"}}}; }
};

FormatPtr<Value> value_format() { return make_format<ValueFormat>(); }

FormatPtr<ProblemDocument::Error> error_format() {
  using Error = ProblemDocument::Error;
  return object<Error>({
      output_only("pointer", &Error::pointer, text()),
      output_only("detail", &Error::detail, text()),
      output_only("value", &Error::value, value_format(), "Value found there"),
  });
}

std::optional<std::vector<ProblemDocument::Error>> errors_of(const ProblemDocument& document) {
  return document.errors.empty() ? std::nullopt : std::optional(document.errors);
}

std::optional<std::vector<StepPlan>> steps_of(const ProblemDocument& document) {
  return document.steps ? std::optional(*document.steps) : std::nullopt;
}

constexpr const char* kTypePrefix = "urn:armloom:problem:";
bool is_type(std::string_view type) { return type.starts_with(kTypePrefix); }

}  // namespace

int status_of(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::malformed:
      return 400;
    case ProblemKind::invalid:
      return 422;
    case ProblemKind::not_found:
      return 404;
    case ProblemKind::conflict:
      return 409;
    case ProblemKind::too_large:
      return 413;
    case ProblemKind::unsupported:
      return 415;
    case ProblemKind::unavailable:
      return 503;
  }
  return 500;
}

FormatPtr<ProblemDocument> problem_format() {
  using Document = ProblemDocument;
  static const auto format = named(
      "Problem", "Problem document (RFC 9457).",
      object<Document>({
          output_only(
              "type", &Document::type,
              text(TextRule{is_type,
                            "bad-type",
                            "the type must begin with urn:armloom:problem:",
                            {{"pattern", std::string("^") + kTypePrefix + "[a-z0-9-]+$"}}})),
          output_only("title", &Document::title, text()),
          output_only("status", &Document::status, integer(400, 599)),
          output_only("detail", &Document::detail, text(),
                      "One sentence with the values found and their units"),
          output_if("pointer", &Document::pointer, text(),
                    "JSON pointer into the body, or the place in words"),
          output_if("value", &Document::value, value_format(), "Value found there"),
          output_if("errors", errors_of, list(error_format(), {.fewest = 2}),
                    "All faults, if there are several"),
          output_if(
              "links", &Document::links, list(text(), {.fewest = 1, .most = 2}),
              "If planning failed: the two links that come too close, or the link that misses "
              "its pose"),
          output_if("clearance_m", &Document::clearance_m, number(kAnyNumber),
                    "Distance of the two links; zero or negative in contact"),
          output_if("required_clearance_m", &Document::required_clearance_m, number({0.0}),
                    "Distance that the two links must keep"),
          output_if("nearest", &Document::nearest, number_list(),
                    "Usable joint positions nearest to the request: the nearest collision-free "
                    "ones; for an unreachable pose, the closest to the pose; for a straight line, "
                    "the farthest point on the line"),
          output_if("evaluations", &Document::evaluations, count(),
                    "Evaluations that planning took"),
          output_if("steps", steps_of, list(step_plan_format()),
                    "If a step of a job cannot be planned: the steps before it"),
      }));
  return format;
}

std::string problem_type(const std::string& slug) { return kTypePrefix + slug; }

std::string problem_title(const std::string& slug) {
  std::string title = slug.empty() ? "bad request" : slug;
  for (char& c : title) {
    if (c == '-') c = ' ';
  }
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

ProblemDocument document_of(const Problems& problems) {
  const Problem& first = problems.front();
  ProblemDocument document{problem_type(first.slug),
                           problem_title(first.slug),
                           status_of(first.kind),
                           first.detail,
                           first.pointer,
                           first.value,
                           {}};
  if (problems.size() == 1) return document;
  for (const Problem& problem : problems) {
    document.errors.push_back({problem.pointer, problem.detail, problem.value});
  }
  return document;
}

std::string problem_json(const Problems& problems) {
  return text_of(*problem_format(), document_of(problems));
}

std::string problem_sentence(std::string_view file, const Problem& problem) {
  std::string text;
  if (problem.pointer.empty()) {
    text = std::string(file);
  } else if (problem.pointer.front() == '/' && !file.empty()) {
    text = std::string(file) + ":" + problem.pointer;
  } else {
    text = problem.pointer;
  }
  if (problem.detail.starts_with(problem.pointer) && !problem.pointer.empty()) text.clear();
  text += (text.empty() ? "" : ": ") + problem.detail;
  const bool has_value = !std::holds_alternative<std::monostate>(problem.value);
  const std::string value = text_of(*value_format(), problem.value);
  const std::string bare = std::holds_alternative<std::string>(problem.value)
                               ? std::get<std::string>(problem.value)
                               : value;
  if (has_value && !bare.empty() && problem.detail.find(bare) == std::string::npos) {
    text += " (found " + value + ")";
  }
  return text;
}

}  // namespace armloom

#include "server/codec/problem_codec.h"

#include <cctype>

#include "server/codec/json_writer.h"

namespace armloom {
namespace {

struct ValueWriter {
  JsonWriter& out;
  void operator()(std::monostate) const { out.value(nullptr); }
  void operator()(double number) const { out.value(number); }
  void operator()(const std::string& text) const { out.value(text); }
};

// "limit-exceeded" -> "Limit exceeded"
std::string title_of(const Problem& problem) {
  std::string title = problem.slug.empty() ? "bad request" : problem.slug;
  for (char& c : title) {
    if (c == '-') c = ' ';
  }
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

std::string spelled(const Problem& problem) {
  JsonWriter out;
  std::visit(ValueWriter{out}, problem.value);
  return out.take();
}

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

std::string problem_json(const Problems& problems) {
  const Problem& first = problems.front();
  JsonWriter out;
  out.begin_object().field("type", "urn:armloom:problem:" + first.slug);
  out.field("title", title_of(first)).field("status", status_of(first.kind));
  out.field("detail", first.detail).field("pointer", first.pointer).key("value");
  std::visit(ValueWriter{out}, first.value);
  if (problems.size() > 1) {
    out.key("errors").begin_array();
    for (const Problem& problem : problems) {
      out.begin_object().field("pointer", problem.pointer).field("detail", problem.detail);
      out.key("value");
      std::visit(ValueWriter{out}, problem.value);
      out.end_object();
    }
    out.end_array();
  }
  out.end_object();
  return out.take();
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
  const std::string value = spelled(problem);
  const std::string bare = std::holds_alternative<std::string>(problem.value)
                               ? std::get<std::string>(problem.value)
                               : value;
  if (has_value && !bare.empty() && problem.detail.find(bare) == std::string::npos) {
    text += " (found " + value + ")";
  }
  return text;
}

}  // namespace armloom

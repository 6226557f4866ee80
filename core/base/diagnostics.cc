#include "core/base/diagnostics.h"

#include <array>
#include <charconv>

namespace armloom {

void Diagnostics::Kept::add(Problem problem) {
  if (seen.contains({problem.pointer, problem.detail})) return;
  std::size_t& alike = of_slug[problem.slug];
  if (alike == kMaxDiagnostics) {
    ++dropped;
    return;
  }
  ++alike;
  seen.emplace(problem.pointer, problem.detail);
  problems.push_back(std::move(problem));
}

Problems Diagnostics::Kept::take(const std::string& kind) {
  if (dropped > 0) {
    problems.push_back({ProblemKind::invalid,
                        "too-many-problems",
                        "",
                        "and " + std::to_string(dropped) + " more " + kind + " of the cell",
                        {}});
  }
  return std::move(problems);
}

void Diagnostics::add(Problem problem) {
  ++added_;
  problems_.add(std::move(problem));
}

void Diagnostics::warn(Problem problem) { warnings_.add(std::move(problem)); }

void Diagnostics::merge(Diagnostics other) {
  for (Problem& problem : other.take()) add(std::move(problem));
  for (Problem& warning : other.take_warnings()) warn(std::move(warning));
}

void Diagnostics::merge_as_warnings(Diagnostics other) {
  for (Problem& problem : other.take()) warn(std::move(problem));
  for (Problem& warning : other.take_warnings()) warn(std::move(warning));
}

void Diagnostics::in_cell(std::string slug, std::string pointer, std::string detail,
                          decltype(Problem::value) value) {
  add({ProblemKind::invalid, std::move(slug), std::move(pointer), std::move(detail),
       std::move(value)});
}

Problems Diagnostics::take() { return problems_.take("problems"); }
Problems Diagnostics::take_warnings() { return warnings_.take("warnings"); }

std::string text_of(double number) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number);
  return {buffer.data(), end.ptr};
}

std::string pointer_token(std::string name) {
  std::string token;
  for (const char c : name) {
    if (c == '~')
      token += "~0";
    else if (c == '/')
      token += "~1";
    else
      token += c;
  }
  return token;
}

}  // namespace armloom

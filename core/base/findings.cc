#include "core/base/findings.h"

#include <array>
#include <charconv>

namespace armloom {

void Findings::Kept::add(Problem problem) {
  if (seen.contains({problem.pointer, problem.detail})) return;
  if (problems.size() == kMaxFindings) {
    ++dropped;
    return;
  }
  seen.emplace(problem.pointer, problem.detail);
  problems.push_back(std::move(problem));
}

Problems Findings::Kept::take(const std::string& kind) {
  if (dropped > 0) {
    problems.push_back({ProblemKind::invalid,
                        "too-many-problems",
                        "",
                        "and " + std::to_string(dropped) + " more " + kind + " of the cell",
                        {}});
  }
  return std::move(problems);
}

void Findings::add(Problem problem) {
  ++added_;
  problems_.add(std::move(problem));
}

void Findings::warn(Problem problem) { warnings_.add(std::move(problem)); }

void Findings::merge(Findings other) {
  for (Problem& problem : other.take()) add(std::move(problem));
  for (Problem& warning : other.take_warnings()) warn(std::move(warning));
}

void Findings::merge_as_warnings(Findings other) {
  for (Problem& problem : other.take()) warn(std::move(problem));
  for (Problem& warning : other.take_warnings()) warn(std::move(warning));
}

void Findings::in_cell(std::string slug, std::string pointer, std::string detail,
                       decltype(Problem::value) value) {
  add({ProblemKind::invalid, std::move(slug), std::move(pointer), std::move(detail),
       std::move(value)});
}

Problems Findings::take() { return problems_.take("problems"); }
Problems Findings::take_warnings() { return warnings_.take("warnings"); }

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

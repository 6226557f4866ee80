#include "core/model/findings.h"

#include <array>
#include <charconv>

namespace armloom {

void Findings::add(Problem problem) {
  ++added_;
  if (seen_.contains({problem.pointer, problem.detail})) return;
  if (kept_.size() == kMaxFindings) {
    ++dropped_;
    return;
  }
  seen_.emplace(problem.pointer, problem.detail);
  kept_.push_back(std::move(problem));
}

void Findings::in_cell(std::string slug, std::string pointer, std::string detail,
                       decltype(Problem::value) value) {
  add({ProblemKind::invalid, std::move(slug), std::move(pointer), std::move(detail),
       std::move(value)});
}

Problems Findings::take() {
  if (dropped_ > 0) {
    kept_.push_back({ProblemKind::invalid,
                     "too-many-problems",
                     "",
                     "and " + std::to_string(dropped_) + " more problems of the cell",
                     {}});
  }
  return std::move(kept_);
}

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

#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <variant>
#include <vector>

namespace armloom {

// The kind of a mistake. The server maps it to an HTTP status, the command line to exit code 2.
enum class ProblemKind {
  malformed,    // cannot be read at all: broken JSON or XML, wrong type
  invalid,      // readable, but never right: limits, sizes, unknown names
  not_found,    // names something that does not exist
  conflict,     // contradicts the present state: id in use, job already ended
  too_large,    // exceeds a documented limit
  unsupported,  // input of a kind that is not supported: content type, <capsule>
  unavailable,  // valid, but not possible now: queue full, shutting down
};

// A client's mistake, with its place and, if any, the value found.
struct Problem {
  ProblemKind kind = ProblemKind::invalid;
  std::string slug;     // stable name for programs, e.g. "limit-exceeded"
  std::string pointer;  // JSON pointer into the input, or "file:line" / "file: element"
  std::string detail;   // one sentence for people, with numbers and units
  std::variant<std::monostate, double, std::string> value = {};  // found at `pointer`
};

// Problems in the order in which they were found. Never an empty list inside a Result.
using Problems = std::vector<Problem>;

template <class T>
using Result = tl::expected<T, Problems>;

[[nodiscard]] inline tl::unexpected<Problems> failure(Problem problem) {
  Problems problems;
  problems.push_back(std::move(problem));
  return tl::unexpected<Problems>(std::move(problems));
}
[[nodiscard]] inline tl::unexpected<Problems> failure(Problems problems) {
  return tl::unexpected<Problems>(std::move(problems));
}

}  // namespace armloom

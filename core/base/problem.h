#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <variant>
#include <vector>

namespace armloom {

// What kind of mistake it is; the server maps it to an HTTP status, the command line to exit 2.
enum class ProblemKind {
  malformed,    // cannot be read at all: broken JSON or XML, wrong type
  invalid,      // can be read, but can never be right: limits, sizes, unknown names
  not_found,    // names something that does not exist
  conflict,     // contradicts the present state: id reused, job already ended
  too_large,    // over a stated bound
  unsupported,  // a kind of input that is not read: content type, <capsule>
  unavailable,  // right, but not now: queue full, shutting down
};

// A client's mistake, as a value. Never a bare "invalid": the place and the value found are in it.
struct Problem {
  ProblemKind kind = ProblemKind::invalid;
  std::string slug;     // stable name for programs, e.g. "limit-exceeded"
  std::string pointer;  // where: JSON pointer into the input, or "file:line" / "file: element"
  std::string detail;   // one sentence for people, with numbers and units
  std::variant<std::monostate, double, std::string> value = {};  // what was found there
};

// One or more problems, in the order found. Never empty when it travels inside a Result.
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

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "server/codec/format.h"

namespace armloom {

// The HTTP status of a kind of problem.
[[nodiscard]] int status_of(ProblemKind kind);

// An RFC 9457 problem document. Several problems: the first one at the top, all in `errors`.
struct ProblemDocument {
  struct Error {
    std::string pointer;  // into the body; else the place in words
    std::string detail;
    decltype(Problem::value) value;
  };
  std::string type;
  std::string title;
  int status;
  std::string detail;
  std::optional<std::string> pointer;
  std::optional<decltype(Problem::value)> value;
  std::vector<Error> errors;  // empty: only the one above
  // Why there is no plan; absent for all other problems.
  std::optional<std::vector<std::string>> links = {};  // that come too close, or do not get there
  std::optional<double> clearance_m = {};              // of these
  std::optional<double> required_clearance_m = {};     // what they were to keep
  std::optional<std::vector<double>> nearest = {};     // joint positions that come nearest
  std::optional<std::uint64_t> evaluations = {};
};
[[nodiscard]] FormatPtr<ProblemDocument> problem_format();

// Precondition: not empty.
[[nodiscard]] ProblemDocument document_of(const Problems& problems);
// Its `type`, and its `title`: "Limit exceeded".
[[nodiscard]] std::string problem_type(const std::string& slug);
[[nodiscard]] std::string problem_title(const std::string& slug);
[[nodiscard]] std::string problem_json(const Problems& problems);

// The same for people, one sentence: "config/x.json:/robots/0/urdf: ...". A pointer that is no JSON
// pointer ("panda.urdf: joint panda_joint3") names its own file.
[[nodiscard]] std::string problem_sentence(std::string_view file, const Problem& problem);

}  // namespace armloom

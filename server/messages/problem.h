#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "server/codec/format.h"

namespace armloom {

struct StepPlan;  // server/messages/steps_plan.h

[[nodiscard]] int status_of(ProblemKind kind);

// An RFC 9457 problem document. It describes the first problem; if there are several, `errors`
// lists all of them.
struct ProblemDocument {
  struct Error {
    std::string pointer;  // JSON pointer, or the place in words
    std::string detail;
    decltype(Problem::value) value;
  };
  std::string type;
  std::string title;
  int status;
  std::string detail;
  std::optional<std::string> pointer;
  std::optional<decltype(Problem::value)> value;
  std::vector<Error> errors;  // empty if there is one problem only
  // Set only if planning failed.
  std::optional<std::vector<std::string>> links = {};  // too close, or one that misses its pose
  std::optional<double> clearance_m = {};              // distance of these links
  std::optional<double> required_clearance_m = {};
  std::optional<std::vector<double>> nearest = {};  // nearest usable joint positions
  std::optional<std::uint64_t> evaluations = {};
  // Set only if a step of a job cannot be planned: the steps before it.
  std::shared_ptr<const std::vector<StepPlan>> steps = {};
};
[[nodiscard]] FormatPtr<ProblemDocument> problem_format();

// Precondition: `problems` is not empty.
[[nodiscard]] ProblemDocument document_of(const Problems& problems);
// For the slug "limit-exceeded", return "urn:armloom:problem:limit-exceeded" and "Limit exceeded".
[[nodiscard]] std::string problem_type(const std::string& slug);
[[nodiscard]] std::string problem_title(const std::string& slug);
[[nodiscard]] std::string problem_json(const Problems& problems);

// Returns one sentence: "config/x.json:/robots/0/urdf: ...". If the problem's place is not a JSON
// pointer ("panda.urdf: joint panda_joint3"), it replaces `file`, because it names its own file.
[[nodiscard]] std::string problem_sentence(std::string_view file, const Problem& problem);

}  // namespace armloom

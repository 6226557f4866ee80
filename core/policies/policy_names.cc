#include "core/policies/policy_names.h"

#include <algorithm>
#include <iterator>

namespace armloom {

std::vector<std::string> policy_names() {
  return {std::begin(kPolicyNames), std::end(kPolicyNames)};
}

std::optional<Problem> unknown_policy(std::string_view name) {
  if (std::find(std::begin(kPolicyNames), std::end(kPolicyNames), name) != std::end(kPolicyNames)) {
    return std::nullopt;
  }
  std::string known;
  for (const std::string_view each : kPolicyNames) {
    known += (known.empty() ? "" : ", ") + std::string(each);
  }
  return Problem{ProblemKind::invalid, "unknown-policy", "/scheduling/policy",
                 "unknown policy \"" + std::string(name) + "\"; known are " + known,
                 std::string(name)};
}

}  // namespace armloom

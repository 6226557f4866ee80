#include "core/policies/policy_names.h"

#include "core/base/enumeration.h"

namespace armloom {

std::vector<std::string> policy_names() {
  std::vector<std::string> names;
  for (const PolicyName name : kValues<PolicyName>) names.emplace_back(to_string(name));
  return names;
}

Result<PolicyName> policy_named(std::string_view name) {
  if (const auto policy = value_named<PolicyName>(name)) return *policy;
  std::string known;
  for (const std::string& each : policy_names()) known += (known.empty() ? "" : ", ") + each;
  return failure(Problem{ProblemKind::invalid, "unknown-policy", "/scheduling/policy",
                         "unknown policy \"" + std::string(name) + "\"; known are " + known,
                         std::string(name)});
}

}  // namespace armloom

#include "core/executive/known_policies.h"

#include <utility>

#include "core/policies/policy_names.h"

namespace armloom {

std::vector<std::string> known_policies() { return policy_names(); }

std::optional<Problems> policy_problems(const std::string& name) {
  auto problem = unknown_policy(name);
  return problem ? std::optional(Problems{std::move(*problem)}) : std::nullopt;
}

}  // namespace armloom

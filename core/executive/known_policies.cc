#include "core/executive/known_policies.h"

#include <utility>

#include "core/policies/policy_names.h"

namespace armloom {

std::vector<std::string> known_policies() { return policy_names(); }

std::optional<Problems> policy_problems(const std::string& name) {
  auto named = policy_named(name);
  return named ? std::nullopt : std::optional(std::move(named.error()));
}

}  // namespace armloom

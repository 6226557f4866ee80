#include "core/executive/known_policies.h"

#include <utility>

#include "core/scheduler/policy.h"

namespace armloom {

std::vector<std::string> known_policies() { return policy_names(); }

std::optional<Problems> policy_problems(const std::string& name, const Cell& cell) {
  auto policy = make_policy(name, cell);
  if (policy) return std::nullopt;
  return std::move(policy.error());
}

}  // namespace armloom

#include "core/policies/policy.h"

#include <algorithm>
#include <iterator>

#include "core/policies/policies.h"

namespace armloom {
namespace {

using Make = std::unique_ptr<const Policy> (*)(const Cell& cell);

// As in kPolicyNames.
constexpr Make kPolicies[] = {make_sequential,     make_lockstep,  make_reservation,
                              make_timed_discrete, make_certified, make_earliest_start,
                              make_coordinated};
static_assert(std::size(kPolicies) == std::size(kPolicyNames));

}  // namespace

Result<std::unique_ptr<const Policy>> make_policy(std::string_view name, const Cell& cell) {
  if (auto problem = unknown_policy(name)) return failure(std::move(*problem));
  const auto named = std::ranges::find(kPolicyNames, name);
  return kPolicies[named - std::begin(kPolicyNames)](cell);
}

}  // namespace armloom

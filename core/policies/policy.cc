#include "core/policies/policy.h"

#include "core/policies/policies.h"

namespace armloom {
namespace {

std::unique_ptr<const Policy> make(PolicyName name, const Cell& cell) {
  switch (name) {
    case PolicyName::sequential:
      return make_sequential(cell);
    case PolicyName::lockstep:
      return make_lockstep(cell);
    case PolicyName::reservation:
      return make_reservation(cell);
    case PolicyName::timed_discrete:
      return make_timed_discrete(cell);
    case PolicyName::certified:
      return make_certified(cell);
    case PolicyName::earliest_start:
      return make_earliest_start(cell);
    case PolicyName::coordinated:
      return make_coordinated(cell);
  }
  return nullptr;
}

}  // namespace

Result<std::unique_ptr<const Policy>> make_policy(std::string_view name, const Cell& cell) {
  const auto named = policy_named(name);
  if (!named) return failure(named.error());
  return make(*named, cell);
}

}  // namespace armloom

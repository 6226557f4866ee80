#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"

namespace armloom {

// All policies, the simplest first. make_policy() (policy.h) creates them.
enum class PolicyName {
  sequential,
  lockstep,
  reservation,
  timed_discrete,
  certified,
  earliest_start,
  coordinated,
};
[[nodiscard]] constexpr const char* to_string(PolicyName name) {
  switch (name) {
    case PolicyName::sequential:
      return "sequential";
    case PolicyName::lockstep:
      return "lockstep";
    case PolicyName::reservation:
      return "reservation";
    case PolicyName::timed_discrete:
      return "timed_discrete";
    case PolicyName::certified:
      return "certified";
    case PolicyName::earliest_start:
      return "earliest_start";
    case PolicyName::coordinated:
      return "coordinated";
  }
  return nullptr;
}
[[nodiscard]] std::vector<std::string> policy_names();

// Problem (invalid, "unknown-policy"): no policy has this name.
[[nodiscard]] Result<PolicyName> policy_named(std::string_view name);

}  // namespace armloom

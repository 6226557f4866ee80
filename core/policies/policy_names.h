#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"

namespace armloom {

// In order of ambition; each is made by make_policy() (policy.h).
inline constexpr std::string_view kPolicyNames[] = {
    "sequential", "lockstep",       "reservation", "timed_discrete",
    "certified",  "earliest_start", "coordinated",
};
[[nodiscard]] std::vector<std::string> policy_names();

// Invalid, "unknown-policy"; nothing: it is one of these.
[[nodiscard]] std::optional<Problem> unknown_policy(std::string_view name);

}  // namespace armloom

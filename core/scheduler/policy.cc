#include "core/scheduler/policy.h"

#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

struct Entry {
  const char* name;
  std::unique_ptr<const Policy> (*make)(const Cell& cell);
};

constexpr Entry kPolicies[] = {
    {"sequential", make_sequential},   {"lockstep", make_lockstep},
    {"reservation", make_reservation}, {"timed_discrete", make_timed_discrete},
    {"certified", make_certified},     {"earliest_start", make_earliest_start},
    {"coordinated", make_coordinated},
};

}  // namespace

std::vector<std::string> policy_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kPolicies) names.emplace_back(entry.name);
  return names;
}

Result<std::unique_ptr<const Policy>> make_policy(std::string_view name, const Cell& cell) {
  std::string known;
  for (const Entry& entry : kPolicies) {
    if (name == entry.name) return entry.make(cell);
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  return failure(Problem{ProblemKind::invalid, "unknown-policy", "/scheduling/policy",
                         "unknown policy \"" + std::string(name) + "\"; known are " + known,
                         std::string(name)});
}

}  // namespace armloom

#include "core/executive/active_policy.h"

#include <utility>

#include "core/executive/executive_impl.h"
#include "core/executive/executive_input.h"

namespace armloom {

std::string Executive::ActivePolicy::name() const {
  return std::string(executive_.scheduler_.policy().name);
}

Result<void> Executive::ActivePolicy::change(const std::string& name) {
  executive_.clock_.note({ExecutiveInput::PolicyChanged{name}});
  auto policy = make_policy(name, *executive_.cell_);
  if (!policy) {
    policy.error().front().pointer = "/policy";
    return failure(std::move(policy.error()));
  }
  const Scheduler& scheduler = executive_.scheduler_;
  if (!scheduler.state().graph.motions().empty()) {
    std::string admitted;
    for (JobId job : scheduler.active()) {
      if (scheduler.find(job)->in<Queued>() != nullptr) continue;
      admitted += (admitted.empty() ? "" : ", ") + executive_.jobs_.key(job);
    }
    return failure(Problem{ProblemKind::conflict, "not-at-rest", "/policy",
                           "cannot change the policy while jobs are admitted: " + admitted});
  }
  executive_.step(ChangePolicy{std::move(*policy)});
  executive_.follow_policy();
  return {};
}

Executive::ActivePolicy Executive::policy() { return ActivePolicy(*impl_); }

}  // namespace armloom

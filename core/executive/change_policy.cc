// Another policy for an executive that runs.
#include <string>
#include <utility>

#include "core/executive/executive_impl.h"
#include "core/executive/executive_input.h"

namespace armloom {

Result<void> Executive::change_policy(const std::string& name) {
  impl_->note({ExecutiveInput::PolicyChanged{name}});
  auto policy = make_policy(name, *impl_->cell_);
  if (!policy) {
    policy.error().front().pointer = "/policy";
    return failure(std::move(policy.error()));
  }
  const Scheduler& scheduler = impl_->scheduler_;
  if (!scheduler.may_change_policy()) {
    std::string admitted;
    for (JobId job : scheduler.active()) {
      if (scheduler.find(job)->is_waiting() && scheduler.find(job)->in<Held>() == nullptr) continue;
      admitted += (admitted.empty() ? "" : ", ") + impl_->jobs_.key(job);
    }
    return failure(
        Problem{ProblemKind::conflict, "not-at-rest", "/policy",
                "the policy changes only while no job is admitted; now there are: " + admitted});
  }
  impl_->step(ChangePolicy{std::move(*policy)});
  return {};
}

}  // namespace armloom

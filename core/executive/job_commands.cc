// Commands to one job that has not ended.
#include <utility>
#include <vector>

#include "core/executive/executive_impl.h"
#include "core/scheduler/ways/replanning.h"

namespace armloom {

Result<JobView> Executive::Impl::cancel(const std::string& key, std::optional<TimePoint> at) {
  const auto id = jobs_.not_ended(key);
  if (!id) return failure(id.error());
  if (at) {
    clock_.held.hold(key, *at);
  } else {
    step(Cancel{*id});
  }
  return publisher_.view(*id);
}

void Executive::Impl::roll_back(const std::string& key) {
  const auto id = jobs_.find(key);
  if (!id) return;
  rolled_back_.push_back(*id);
  if (jobs_.not_ended(key)) step(Cancel{*id});
  forget_rolled_back();
}

// Not within a step, whose effects may speak of it.
void Executive::Impl::forget_rolled_back() {
  std::erase_if(rolled_back_, [this](JobId id) {
    const Step* step = scheduler_.find(id);
    if (step != nullptr && !step->has_ended()) return false;
    publisher_.forget(id, jobs_.key(id));
    jobs_.forget(id);
    scheduler_.forget(id);
    return true;
  });
}

Result<JobView> Executive::Impl::amend(const std::string& key, JobAmendment amendment) {
  const auto id = jobs_.not_ended(key);
  if (!id) return failure(id.error());
  if (amendment.name) jobs_.rename(*id, *std::move(amendment.name));
  step(Amend{*id, amendment.terms});
  return publisher_.view(*id);
}

Result<JobView> Executive::Impl::replan(const std::string& key) {
  const auto id = jobs_.not_ended(key);
  if (!id) return failure(id.error());
  if (const auto why = why_not_replanned(*scheduler_.find(*id))) {
    return failure(Problem{ProblemKind::conflict, "no-alternative-path", "",
                           "job \"" + key + "\" cannot be replanned: " + *why, key});
  }
  step(Replan{*id});
  return publisher_.view(*id);
}

}  // namespace armloom

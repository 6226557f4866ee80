#include "core/scheduler/without_orders.h"

#include <algorithm>

#include "core/jobs/pace.h"
#include "core/jobs/phases.h"
#include "core/jobs/standing.h"
#include "core/model/promises.h"
#include "core/policies/policy.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

bool has_no_orders(const State& state) {
  return std::holds_alternative<TimedDiscrete>(state.policy->method);
}

}  // namespace

void compare_again(State& state) {
  if (!has_no_orders(state)) return;
  const std::vector<JobId> ids = state.jobs.past_queue();
  for (JobId id : ids) {
    Record& record = state.jobs.at(id);
    record.asking.is_in_question = true;
    const bool is_kept =
        record.job.in<Admitted>() != nullptr && any_closed(state, record, is_ended_by_client);
    if (is_kept) withdraw(state, record, {});
  }
  ++state.version;
}

void see_standing(State& state) {
  if (!has_no_orders(state)) return;
  bool is_news = false;
  const std::vector<JobId> ids = state.jobs.past_queue();
  for (JobId id : ids) {
    Job& job = state.jobs.at(id).job;
    auto* moving = std::get_if<Moving>(&job.phase);
    if (moving == nullptr || moving->was_compared || !is_standing(*state.cell, job, state.now)) {
      continue;
    }
    moving->was_compared = is_news = true;
  }
  if (is_news) compare_again(state);
}

std::optional<TimePoint> stands_next(const State& state) {
  if (!has_no_orders(state)) return std::nullopt;
  std::optional<TimePoint> next;
  for (JobId id : state.jobs.past_queue()) {
    const Job& job = state.jobs.at(id).job;
    const auto* moving = job.in<Moving>();
    if (moving == nullptr || moving->was_compared) continue;
    const TimePoint stands =
        moving->moved_at + promises_of(*state.cell, job.trajectory->arms()).stands_from();
    next = next ? std::min(*next, stands) : stands;
  }
  return next;
}

}  // namespace armloom

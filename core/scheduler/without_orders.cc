#include "core/scheduler/without_orders.h"

#include <algorithm>

#include "core/jobs/pace.h"
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

void compare_again(Transitions& state) {
  if (!has_no_orders(state)) return;
  const std::vector<JobId> ids = state->jobs.past_queue();
  for (JobId id : ids) {
    const Step& step = state->jobs.at(id);
    state.jobs().put_in_question(step);
    const bool is_kept =
        step.in<Admitted>() != nullptr && any_closed(state, step, is_ended_by_client);
    if (is_kept) state.withdraw(step, {});
  }
}

void see_standing(Transitions& state) {
  if (!has_no_orders(state)) return;
  bool is_news = false;
  const std::vector<JobId> ids = state->jobs.past_queue();
  for (JobId id : ids) {
    const Step& step = state->jobs.at(id);
    const auto* moving = step.in<Moving>();
    if (moving == nullptr || moving->was_compared || !is_standing(*state->cell, step, state->now)) {
      continue;
    }
    Moving next = *moving;
    next.was_compared = is_news = true;
    state.jobs().set(step, next);
  }
  if (is_news) compare_again(state);
}

std::optional<TimePoint> stands_next(const State& state) {
  if (!has_no_orders(state)) return std::nullopt;
  std::optional<TimePoint> next;
  for (JobId id : state.jobs.past_queue()) {
    const Step& step = state.jobs.at(id);
    const auto* moving = step.in<Moving>();
    if (moving == nullptr || moving->was_compared) continue;
    const TimePoint stands =
        moving->moved_at + promises_of(*state.cell, step.trajectory->arms()).stands_from();
    next = next ? std::min(*next, stands) : stands;
  }
  return next;
}

}  // namespace armloom

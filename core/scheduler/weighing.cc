#include "core/scheduler/weighing.h"

#include <algorithm>

#include "core/jobs/standing.h"
#include "core/model/promises.h"
#include "core/policies/policy.h"
#include "core/scheduler/waiting/gates.h"

namespace armloom {
namespace {

constexpr Duration kEvery = std::chrono::milliseconds(250);
// Motions that have rested for longer are not looked at any more.
constexpr Duration kStandsForGood = std::chrono::minutes(10);

}  // namespace

std::vector<Duration> work_behind(const State& state, const std::vector<const Step*>& in_front) {
  std::vector<Duration> work = state.jobs.queues().work_but(in_front);
  for (std::uint32_t arm = 0; arm < work.size(); ++arm) {
    work[arm] = paced(work[arm], state.speed.pace({ArmId{arm}}));
  }
  return work;
}

void prepare_choice(Transitions& state, const std::vector<StepId>& steps) {
  std::vector<const Step*> in_front;
  for (StepId step : steps) in_front.push_back(&state->jobs.at(step));
  for (const CoordinatedMotion& motion : state->graph.motions()) {
    const Step& step = state->jobs.at(motion.step);
    const bool weighs = state->policy->lookahead.weighs_again;
    const Duration stands = weighs ? stood_for(*state->cell, step, state->now) : Duration{};
    const bool is_aged = state->has_aged(step);
    const double planned = state->speed.pace(motion.arms);
    state.set_outlook(
        motion.step, {.keeps_its_place = is_aged && stands <= Duration{},
                      .stands_for = stands,
                      .pace = weighs ? pace_of(*state->cell, step, planned, state->now) : planned});
    in_front.push_back(&step);
  }
  state.set_work_behind(work_behind(state, in_front));
}

bool is_off_course(const State& state) {
  return state.policy->lookahead.weighs_again &&
         state.expected.is_missed(state.graph.motions(), state.now);
}

void weigh_again(Transitions& state) {
  if (!is_off_course(state)) return;
  prepare_choice(state, {});
  const std::vector<CoordinatedMotion> nobody;
  const std::vector<PairRegions> nothing;
  state.renew_orders(state->policy->decide(state->graph.question(nobody, nothing)));
}

// A moving motion may be late. A stopped motion may rest for longer than predicted while another
// one waits for it; it is looked at less and less often.
std::optional<TimePoint> weighs_next(const State& state) {
  if (!state.policy->lookahead.weighs_again) return std::nullopt;
  const auto job_of = [&](StepId step) -> const Step& { return state.jobs.at(step); };
  const bool moves = std::ranges::any_of(state.graph.motions(), [&](const auto& motion) {
    const auto* moving = job_of(motion.step).template in<Moving>();
    return moving != nullptr && !moving->pause;
  });
  if (moves) return TimePoint((state.now.time_since_epoch() / kEvery + 1) * kEvery);
  std::optional<TimePoint> next;
  for (const Precedence& order : state.graph.precedences()) {
    const auto since = stands_since(job_of(order.first()));
    if (!since || stands_since(job_of(order.second()))) continue;
    const Duration stood = state.now - *since;
    if (stood > kStandsForGood) continue;
    Duration looks = kEvery;
    while (looks <= stood) looks *= 2;
    next = next ? std::min(*next, *since + looks) : *since + looks;
  }
  return next;
}

void compare_again(Transitions& state) {
  if (state->policy->has_orders()) return;
  for (const Step& step : state->jobs.past_queue_now()) {
    state.jobs().put_in_question(step);
    const bool is_kept =
        step.in<Admitted>() != nullptr && any_closed(state, step, is_ended_by_client);
    if (is_kept) state.withdraw(step, {});
  }
}

void see_standing(Transitions& state) {
  if (state->policy->has_orders()) return;
  bool is_news = false;
  for (const Step& step : state->jobs.past_queue()) {
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
  if (state.policy->has_orders()) return std::nullopt;
  std::optional<TimePoint> next;
  for (const Step& step : state.jobs.past_queue()) {
    const auto* moving = step.in<Moving>();
    if (moving == nullptr || moving->was_compared) continue;
    const TimePoint stands =
        moving->moved_at + promises_of(*state.cell, step.trajectory->arms()).stands_from();
    next = next ? std::min(*next, stands) : stands;
  }
  return next;
}

}  // namespace armloom

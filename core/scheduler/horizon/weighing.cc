#include "core/scheduler/horizon/weighing.h"

#include <algorithm>
#include <utility>

#include "core/scheduler/policy.h"

namespace armloom {
namespace {

constexpr Duration kEvery = std::chrono::milliseconds(250);
// An arm that sets out or brakes may be seen so long in one place.
constexpr Duration kStandsFrom = std::chrono::milliseconds(250);
// The pace of a motion is told from so much of its way, and counts from there on.
constexpr Duration kPaceFrom = std::chrono::milliseconds(100);
constexpr double kHardlySlow = 1.1;
// Who has stood for so long is not looked at any more.
constexpr Duration kStandsForGood = std::chrono::minutes(10);

// Since when its arms have stood for no reason of ours.
std::optional<TimePoint> stands_since(const Job& job) {
  if (const auto* moving = job.in<Moving>()) {
    return moving->pause ? std::nullopt : std::optional(moving->moved_at);
  }
  const bool stopped = job.in<Braking>() != nullptr || job.in<Held>() != nullptr;
  return stopped ? std::optional(job.times.measured_at) : std::nullopt;
}

}  // namespace

bool is_standing(const Moving& moving, TimePoint now) {
  return now - moving.moved_at >= kStandsFrom;
}

Duration stood_for(const Job& job, TimePoint now) {
  const auto since = stands_since(job);
  const Duration stood = since ? now - *since : Duration{};
  return stood < kStandsFrom ? Duration{} : stood;
}

double pace_of(const Job& job, TimePoint now) {
  const auto* moving = job.in<Moving>();
  if (moving == nullptr || moving->pause || is_standing(*moving, now)) return 1.0;
  const Duration way = job.progress - moving->goes_from;
  if (way < kPaceFrom) return 1.0;
  const double pace = to_seconds(moving->moved_at - moving->goes_since) / to_seconds(way);
  return pace < kHardlySlow ? 1.0 : pace;
}

void prepare_choice(State& state, const std::vector<JobId>& jobs) {
  std::vector<const Job*> in_front;
  for (JobId id : jobs) in_front.push_back(&state.jobs.at(id).job);
  for (const CoordinatedMotion& motion : state.graph.motions()) {
    const Record& record = state.jobs.at(motion.job);
    const bool weighs = state.policy->weighs_again();
    const Duration stands = weighs ? stood_for(record.job, state.now) : Duration{};
    const bool is_aged =
        record.ages_from && state.now - *record.ages_from >= state.cell->scheduling.aging;
    state.graph.set_outlook(motion.job, {.keeps_its_place = is_aged && stands <= Duration{},
                                         .stands_for = stands,
                                         .pace = weighs ? pace_of(record.job, state.now) : 1.0});
    in_front.push_back(&record.job);
  }
  state.graph.set_work_behind(state.jobs.queues().work_but(in_front));
}

void weigh_again(State& state) {
  if (!state.policy->weighs_again()) return;
  if (!state.expected.is_missed(state.graph.motions(), state.now)) return;
  prepare_choice(state, {});
  const std::vector<CoordinatedMotion> nobody;
  const std::vector<PairRegions> nothing;
  const PassingOrders orders = state.policy->decide(state.graph.question(nobody, nothing));
  const std::size_t motions = state.graph.motions().size();
  // None found, as when admitted motions wait for each other: then the orders of before stand.
  const bool found = orders.blockers.empty() && orders.prediction.ends.size() == motions;
  if (found) state.graph.admit(nobody, orders);
  state.expected.renew(found ? state.graph.motions() : nobody, orders.prediction, state.now);
}

// Who moves may be late. Who was stopped may stand for longer than expected, while another one
// waits for it: that is looked at less and less often.
std::optional<TimePoint> weighs_next(const State& state) {
  if (!state.policy->weighs_again()) return std::nullopt;
  const auto job_of = [&](JobId id) -> const Job& { return state.jobs.at(id).job; };
  const bool moves = std::ranges::any_of(state.graph.motions(), [&](const auto& motion) {
    const auto* moving = job_of(motion.job).template in<Moving>();
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

}  // namespace armloom

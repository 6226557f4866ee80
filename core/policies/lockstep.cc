// Synchronous execution, the baseline of the paper's experiments: rounds of one job for each arm.
// They start together; those in conflict within a round follow one after the other. The next round
// begins when all have ended.
#include <algorithm>

#include "core/jobs/standing.h"
#include "core/policies/policies.h"

namespace armloom {
namespace {

// Waits for something else of the round, or for an arm that has no job in it, or for an open arm.
bool stands_in_vain(const State& state, const Step& step) {
  const bool tried = step.is_waiting() && (state.is_judged(step) || !is_at_head(state.jobs, step) ||
                                           may_go_first(state, step).has_value());
  return tried || held_where_it_stands(state, step).has_value();
}

class LockstepPolicy final : public Policy {
 public:
  explicit LockstepPolicy(const Cell& cell) : tracking_errors_(cell) {}

  std::string_view name() const override { return "lockstep"; }
  // A round is over when all of its jobs have ended; until the first of them moves, arms that have
  // no job in it may join. Where those that are left wait for arms that only a next job would move
  // away, these jobs join too; and so does what was placed before one of them.
  Round next_round(const State& state) const override {
    Round round = state.round;
    const JobBook& book = state.jobs;
    std::erase_if(round.jobs, [&](JobId id) { return !book.is_active(id); });
    for (const auto& queue : book.queues()) {
      for (const StepId step : queue) {
        const auto& before = book.at(step).job->errand.before;
        if (!before) break;
        if (round.jobs.contains(*before)) round.jobs.insert(step.job);
      }
    }
    const bool stuck = std::ranges::all_of(
        round.jobs, [&](JobId id) { return stands_in_vain(state, book.at(id)); });
    if (round.jobs.empty()) round.has_begun = false;
    for (JobId id : round.jobs) round.has_begun |= book.at(id).has_started();
    if (round.has_begun && !stuck) return round;
    for (const auto& queue : book.queues()) {
      if (queue.empty()) continue;
      const Step& step = book.at(queue.front());
      const bool goes = step.is_waiting() && !step.is_unplanned() && is_at_head(book, step) &&
                        !operator_wait(state, step) && !may_go_first(state, step);
      if (goes) round.jobs.insert(step.id.job);
    }
    return round;
  }
  std::optional<JobId> place_taken_by(const State& state, const Step& step) const override {
    const auto& jobs = state.round.jobs;
    if (jobs.contains(step.id.job) || jobs.empty()) return std::nullopt;
    return *jobs.begin();
  }
  bool opens_places() const override { return true; }
  bool lets_jobs_age() const override { return false; }  // rounds are fair by themselves
  CheckMethod method() const override { return Coordinated{tracking_errors_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_in_time(question, Duration{});
  }

 private:
  TrackingErrors tracking_errors_;
};

}  // namespace

std::unique_ptr<const Policy> make_lockstep(const Cell& cell) {
  return std::make_unique<LockstepPolicy>(cell);
}

}  // namespace armloom

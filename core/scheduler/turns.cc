// Whose turn it is among the jobs that wait, and why: aging, priorities without inversion.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/scheduler/deadlock.h"
#include "core/scheduler/fairness.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// By submission, but for those that took their places before others: these stand first of their
// arms, in the order in which they came.
std::vector<JobId> Scheduler::in_turn(const std::set<JobId>& jobs) const {
  std::map<JobId, JobId> behind;  // the first job of the arm that did not
  for (const auto& queue : order_) {
    const auto first = std::ranges::find_if_not(
        queue, [this](JobId id) { return records_.at(id).before.has_value(); });
    if (first == queue.end()) continue;
    for (auto id = queue.begin(); id != first; ++id) behind.emplace(*id, *first);
  }
  std::vector<JobId> sorted(jobs.begin(), jobs.end());
  if (behind.empty()) return sorted;
  std::ranges::sort(sorted, {}, [&behind](JobId id) {
    const auto first = behind.find(id);
    const bool placed = first != behind.end();
    return std::tuple(placed ? first->second : id, !placed, id);
  });
  return sorted;
}

bool Scheduler::lets_another_pass(const Record& record) const {
  return record.lets_pass && active_.contains(*record.lets_pass) &&
         waiting(records_.at(*record.lets_pass));
}

// What is undecided counts as a conflict: it stays so while nothing moves.
std::optional<JobId> Scheduler::has_to_move_first(const Wait& wait) const {
  if (wait.kind == Wait::Kind::order) {  // it shall be done before, lest it never can be
    const bool still = active_.contains(*wait.job) && stands(records_.at(*wait.job));
    return still ? wait.job : std::nullopt;
  }
  const bool of_job = wait.kind == Wait::Kind::job;
  if (!of_job && wait.kind != Wait::Kind::arm) return std::nullopt;
  if (of_job && !active_.contains(*wait.job)) return std::nullopt;
  std::optional<JobId> first = wait.job;
  const bool begun = of_job && records_.at(*wait.job).job.started_at;
  if (!begun && wait.arm) {  // its arm moves with its next job
    const auto& queue = order_[wait.arm->index()];
    first = queue.empty() ? std::nullopt : std::optional(queue.front());
  }
  if (!first) return std::nullopt;
  return stands(records_.at(*first)) ? first : std::nullopt;
}

// What was found when it was judged last, if that still counts; of what is admitted, what holds it.
std::vector<Wait> Scheduler::found_in_the_way(const Record& record) const {
  if (waiting(record)) return record.judged_at == version_ ? record.found : std::vector<Wait>{};
  const auto held = held_where_it_stands(record);
  return held ? std::vector<Wait>{*held} : std::vector<Wait>{};
}

WaitsFor Scheduler::waits_for() const {
  std::vector<WaitsForEdge> edges;
  for (const auto& queue : order_) {
    for (std::size_t i = 1; i < queue.size(); ++i) {
      if (stands(records_.at(queue[i - 1]))) edges.push_back({queue[i], queue[i - 1]});
    }
  }
  for (JobId id : active_) {
    const Record& record = records_.at(id);
    if (!stands(record)) continue;
    for (JobId before : record.job.after) {
      if (stands(records_.at(before))) edges.push_back({id, before});
    }
    if (lets_another_pass(record)) edges.push_back({id, *record.lets_pass});
    for (const Wait& wait : found_in_the_way(record)) {
      const auto first = has_to_move_first(wait);
      if (!first) continue;
      if (wait.kind == Wait::Kind::arm) {
        edges.push_back({id, *wait.arm});
        edges.push_back({*wait.arm, *first});
      } else {
        edges.push_back({id, *first});
      }
    }
  }
  return WaitsFor(std::move(edges));
}

// ---- What is told ----

// Which job stands before it, on the first of its arms where one does.
std::optional<Wait> Scheduler::order_of(const Record& record) const {
  for (ArmId arm : record.job.trajectory->arms()) {
    const auto& queue = order_[arm.index()];
    if (queue.front() == record.job.id) continue;
    const auto ahead = std::next(std::find(queue.rbegin(), queue.rend(), record.job.id));
    return Wait{.kind = Wait::Kind::order, .job = *ahead, .arm = arm};
  }
  return std::nullopt;
}

// What is not the first of an arm waits for the one before it, as long as that is the same.
void Scheduler::explain_waits() {
  const std::vector<const Job*> occupied_by = occupying();
  const std::vector<Aged> aged = aged_jobs();
  std::set<JobId> jobs = std::exchange(unexplained_, {});
  for (const auto& queue : order_) {
    if (!queue.empty()) jobs.insert(queue.front());
  }
  for (JobId id : jobs) {
    Record& record = records_.at(id);
    std::optional<Wait> wait = order_of(record);
    const bool stands_behind = record.job.state == JobState::scheduled && !record.dispatched;
    if (stands_behind && wait) set_waits(record, {std::move(*wait)});
    if (!waiting(record)) continue;
    if (!wait && !record.job.after.empty()) {
      wait = Wait{.kind = Wait::Kind::order, .job = record.job.after.front()};
    }
    if (!wait && lets_another_pass(record)) {
      wait = Wait{.kind = Wait::Kind::order, .job = *record.lets_pass};
    }
    if (!wait) wait = stop_of(record);
    if (!wait && (wait = capacity_of(record, occupied_by)) && !record.ages_from) {
      record.ages_from = now_;
    }
    if (!wait && record.judged_at != version_) {
      if (const auto old = held_back_by(record, aged)) {
        if (records_.at(*old).judged_at != version_) continue;  // it may be about to go
        wait = Wait{.kind = Wait::Kind::order, .job = *old};
      }
    }
    if (wait) {
      set_waits(record, {std::move(*wait)});
    } else if (record.judged_at == 0) {
      set_waits(record, {});  // nothing stands against it but that it is not judged yet
    }
  }
}

// ---- Priorities ----

std::map<JobId, int> Scheduler::urgencies() const {
  if (priorities_.size() <= 1) return {};
  std::vector<Urgency> jobs;
  for (JobId id : active_) {
    const Record& record = records_.at(id);
    if (waiting(record)) jobs.push_back({id, record.job.priority});
  }
  return effective_priorities(waits_for(), std::move(jobs));
}

// ---- Aging ----

bool Scheduler::is_aged(const Record& record) const {
  return waiting(record) && record.job.state != JobState::holding && record.ages_from &&
         now_ - *record.ages_from >= cell_->scheduling.aging && at_head(record) && !stop_of(record);
}

// Nothing that other jobs do or leave would let it go: an arm that no job will move, an object, a
// stop.
bool Scheduler::waits_beyond_turns(const Record& record) const {
  if (!at_head(record)) return false;
  if (stop_of(record)) return true;
  if (record.judged_at != version_) return false;
  return std::ranges::any_of(record.found, [&](const Wait& wait) {
    if (wait.kind != Wait::Kind::arm) return wait.kind == Wait::Kind::object;
    const auto& queue = order_[wait.arm->index()];
    const bool moves = !queue.empty() && !waiting(records_.at(queue.front()));
    return !moves && !has_to_move_first(wait);
  });
}

std::vector<Scheduler::Aged> Scheduler::aged_jobs() const {
  std::vector<Aged> aged;
  if (policy_->in_rounds()) return aged;  // rounds are fair by themselves
  for (const auto& queue : order_) {
    if (!queue.empty() && is_aged(records_.at(queue.front()))) aged.push_back({queue.front(), {}});
  }
  if (aged.empty()) return aged;
  std::ranges::sort(
      aged, {}, [this](const Aged& a) { return std::pair(*records_.at(a.job).ages_from, a.job); });
  const auto again = std::ranges::unique(aged, {}, &Aged::job);  // a job of several arms
  aged.erase(again.begin(), again.end());
  const WaitsFor graph = waits_for();
  for (Aged& a : aged) {
    for (const Waiter& before : graph.all_before(a.job)) {
      if (const auto* job = std::get_if<JobId>(&before)) a.goes_first.push_back(*job);
    }
  }
  std::erase_if(aged, [this](const Aged& a) {
    return waits_beyond_turns(records_.at(a.job)) ||
           std::ranges::any_of(a.goes_first,
                               [this](JobId id) { return waits_beyond_turns(records_.at(id)); });
  });
  return aged;
}

std::optional<JobId> Scheduler::held_back_by(const Record& record,
                                             const std::vector<Aged>& aged) const {
  if (record.job.state == JobState::holding) return std::nullopt;
  for (const Aged& a : aged) {
    // It has this one's turn: those that are aged for less long do not hold it back either.
    if (a.job == record.job.id) break;
    if (std::ranges::binary_search(a.goes_first, record.job.id)) break;
    const Job& old = records_.at(a.job).job;
    const bool outranks = record.job.id < old.id && record.job.priority > old.priority;
    if (!outranks) return a.job;
  }
  return std::nullopt;
}

}  // namespace armloom

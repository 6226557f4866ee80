#include "core/jobs/job_book.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace armloom {
namespace {

// The table in job.h. What only gets other data stays in its phase.
bool leads_to(const JobPhase& from, const JobPhase& to) {
  struct Allowed {
    bool queued, admitted, moving, braking, held, ended;
  };
  static constexpr Allowed kTable[] = {
      {true, true, false, false, false, true},     // Queued
      {true, true, true, false, true, true},       // Admitted
      {false, true, true, true, true, true},       // Moving
      {true, true, false, true, true, true},       // Braking
      {true, true, false, false, true, true},      // Held
      {false, false, false, false, false, false},  // Ended
  };
  const Allowed& row = kTable[from.index()];
  const bool allowed[] = {row.queued, row.admitted, row.moving, row.braking, row.held, row.ended};
  return allowed[to.index()];
}

}  // namespace

void JobIds::take(JobId id) {
  std::uint64_t& last = id.value() < first_ ? last_former_ : last_;
  if (id.value() <= last) throw std::invalid_argument("Submit: ids must grow");
  last = id.value();
}

Record& JobBook::add(Record record) {
  const Job& job = record.job;
  ids_.take(job.id);
  const auto& before = record.errand.before;
  queues_.insert(job, before ? std::optional(only_step(*before)) : std::nullopt);
  queues_.add_work(job);
  active_.insert(job.id);
  if (!job.alternatives.empty()) undecided_.insert(job.id);
  if (job.goal) ++goals_;
  news_.unexplained.insert(job.id);
  if (before) news_.unexplained.insert(*before);
  ++priorities_[job.terms.priority];
  for (JobId first : job.after) followers_[first].push_back(job.id);
  Record& added = records_.emplace(job.id, std::move(record)).first->second;
  changed(added);
  return added;
}

void JobBook::forget(JobId job) { records_.erase(job); }

Record* JobBook::find(JobId job) {
  const auto it = records_.find(job);
  return it == records_.end() ? nullptr : &it->second;
}

const Record* JobBook::find(JobId job) const {
  const auto it = records_.find(job);
  return it == records_.end() ? nullptr : &it->second;
}

void JobBook::put_in_order(const std::vector<JobId>& jobs) {
  std::vector<StepId> steps;
  std::vector<JobId> turns;
  for (JobId id : jobs) {
    steps.push_back(only_step(id));
    turns.push_back(at(id).turn);
  }
  queues_.put_in_order(at(jobs.front()).job, steps);
  std::ranges::sort(turns);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    at(jobs[i]).turn = turns[i];
    explain_with_next(at(jobs[i]).job);
  }
}

void JobBook::take(Record& record, TrajectoryPtr trajectory, WaitingLeg leg, std::size_t place) {
  Job& job = record.job;
  explain_with_next(job);
  queues_.erase(job);
  job.trajectory = std::move(trajectory);
  leg.motion = record.leg.motion + 1;
  record.leg = std::move(leg);
  queues_.insert_at(job, place);
  explain_with_next(job);
}

void JobBook::set_motion(Record& record, TrajectoryPtr trajectory, WaitingLeg leg) {
  Job& job = record.job;
  queues_.remove_work(job);
  job.trajectory = std::move(trajectory);
  leg.motion = record.leg.motion + 1;
  record.leg = std::move(leg);
  record.asking.effort = 1;
  record.asking.raised = 0;
  if (auto* queued = std::get_if<Queued>(&job.phase)) queued->judgement = {};
  queues_.add_work(job);
  explain_with_next(job);
  changed(record);
}

void JobBook::set_priority(Record& record, int priority) {
  int& now = record.job.terms.priority;
  if (--priorities_.at(now) == 0) priorities_.erase(now);
  now = priority;
  ++priorities_[now];
  changed(record);
}

void JobBook::set_alternative(Record& record, std::size_t which, TrajectoryPtr trajectory,
                              WaitingLeg leg) {
  Job& job = record.job;
  const bool is_taken = job.trajectory == job.alternatives[which];
  queues_.remove_work(job);
  job.alternatives[which] = trajectory;
  queues_.add_work(job);
  if (is_taken) set_motion(record, std::move(trajectory), std::move(leg));
}

void JobBook::decide_arm(Record& record) {
  queues_.remove_work(record.job);
  record.job.alternatives.clear();
  queues_.add_work(record.job);
  undecided_.erase(record.job.id);
  changed(record);
}

// What comes next on its arms may have waited for it, or does now.
void JobBook::explain_with_next(const Job& job) {
  news_.unexplained.insert(job.id);
  for (ArmId arm : job.trajectory->arms()) {
    if (const auto next = queues_.behind(job, arm)) news_.unexplained.insert(next->job);
  }
}

void JobBook::enter(Record& record, JobPhase phase) {
  Job& job = record.job;
  if (!leads_to(job.phase, phase)) {
    throw std::logic_error("job " + std::to_string(job.id.value()) + ": no transition from phase " +
                           std::to_string(job.phase.index()) + " to " +
                           std::to_string(phase.index()));
  }
  if (!job.alternatives.empty()) queues_.remove_work(job);
  job.phase = std::move(phase);
  if (!job.alternatives.empty()) queues_.add_work(job);
  const bool is_decided = job.alternatives.empty() || job.in<Queued>() == nullptr;
  is_decided ? (void)undecided_.erase(job.id) : (void)undecided_.insert(job.id);
  const auto place = std::ranges::lower_bound(past_queue_, job.id);
  const bool was_past = place != past_queue_.end() && *place == job.id;
  const bool is_past = job.state() != JobState::queued && !job.has_ended();
  if (was_past && !is_past) past_queue_.erase(place);
  if (is_past && !was_past) past_queue_.insert(place, job.id);
  explain_with_next(job);
}

std::vector<JobId> JobBook::end(Record& record, Ended how) {
  enter(record, std::move(how));
  Job& job = record.job;
  const Ended& ended = *job.in<Ended>();
  if (ended.reason != Reason::deadlock) job.ring.clear();
  if (ended.state != JobState::expired) job.waits_on.clear();  // else: what it waited for in vain
  if (ended.state == JobState::succeeded) job.progress = job.trajectory->duration();
  queues_.erase(job);
  queues_.remove_work(job);
  active_.erase(job.id);
  if (job.goal) --goals_;
  news_.unexplained.erase(job.id);
  if (--priorities_.at(job.terms.priority) == 0) priorities_.erase(job.terms.priority);
  changed(record);
  const auto node = followers_.extract(job.id);
  return node.empty() ? std::vector<JobId>{} : node.mapped();
}

void JobBook::set_waits(Record& record, std::span<const Wait> waits) {
  auto& old = record.job.waits_on;
  if (std::ranges::equal(old, waits)) return;
  const bool same =
      std::ranges::equal(old, waits, [](const Wait& a, const Wait& b) { return a.same_cause(b); });
  old.assign(waits.begin(), waits.end());
  if (!same) changed(record);
}

std::vector<const Job*> occupying(const JobBook& book) {
  std::vector<const Job*> jobs;
  for (JobId id : book.past_queue()) {
    const Job& job = book.at(id).job;
    if (job.in<Held>() != nullptr || job.has_authority()) jobs.push_back(&job);
  }
  return jobs;
}

bool lets_another_pass(const JobBook& book, const Record& record) {
  return record.errand.lets_pass && book.is_active(*record.errand.lets_pass) &&
         book.at(*record.errand.lets_pass).job.is_waiting();
}

// Sorts by turn, but keeps the order of each arm's queue. An errand (Errand::before) counts with
// the turn of the first job behind it in the queue that is no errand.
std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs) {
  std::map<JobId, JobId> behind;  // of an errand: the job whose turn counts
  for (const auto& queue : book.queues()) {
    std::optional<JobId> first;
    for (auto step = queue.rbegin(); step != queue.rend(); ++step) {
      if (!book.at(*step).errand.before) {
        first = step->job;
      } else if (first) {
        behind.emplace(step->job, *first);
      }
    }
  }
  std::vector<JobId> by_turn(jobs.begin(), jobs.end());
  const auto turn = [&](JobId id) { return book.at(id).turn; };
  if (!behind.empty() || !std::ranges::is_sorted(by_turn, {}, turn)) {
    std::ranges::sort(by_turn, {}, [&](JobId id) {
      const auto first = behind.find(id);
      const bool placed = first != behind.end();
      return std::tuple(placed ? turn(first->second) : turn(id), !placed, turn(id));
    });
  }
  std::vector<JobId> sorted;
  std::set<JobId> left = jobs;
  std::vector<std::size_t> passed(
      book.queues().size());  // by ArmId: jobs of its queue that are taken
  const auto take = [&](JobId job, const auto& again) -> void {
    if (left.erase(job) == 0) return;
    for (const ArmId arm : book.at(job).leg.arms) {
      const auto& queue = book.queues()[arm];
      std::size_t& next = passed[arm.index()];
      for (; next < queue.size() && queue[next].job != job; ++next) again(queue[next].job, again);
    }
    sorted.push_back(job);
  };
  for (const JobId job : by_turn) take(job, take);
  return sorted;
}

}  // namespace armloom

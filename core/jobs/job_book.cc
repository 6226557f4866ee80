#include "core/jobs/job_book.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace armloom {
namespace {

// The table in step.h. What only gets other data stays in its phase.
bool leads_to(const StepPhase& from, const StepPhase& to) {
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

Step& JobBook::add(Step step) {
  const JobId id = step.id.job;
  ids_.take(id);
  const auto& before = step.job->errand.before;
  queues_.insert(step, before ? std::optional(only_step(*before)) : std::nullopt);
  queues_.add_work(step);
  active_.insert(id);
  if (!step.alternatives.empty()) undecided_.insert(id);
  if (step.goal) ++goals_;
  news_.unexplained.insert(id);
  if (before) news_.unexplained.insert(*before);
  ++priorities_[step.job->terms.priority];
  for (JobId first : step.job->after) followers_[first].push_back(id);
  Step& added = steps_.emplace(step.id, std::move(step)).first->second;
  changed(added);
  return added;
}

void JobBook::forget(JobId job) { steps_.erase(only_step(job)); }

Step* JobBook::find(StepId step) {
  const auto it = steps_.find(step);
  return it == steps_.end() ? nullptr : &it->second;
}

const Step* JobBook::find(StepId step) const {
  const auto it = steps_.find(step);
  return it == steps_.end() ? nullptr : &it->second;
}

Job& JobBook::change(Step& step) {
  if (step.job.use_count() > 1) step.job = std::make_shared<Job>(*step.job);
  return const_cast<Job&>(*step.job);
}

void JobBook::put_in_order(const std::vector<JobId>& jobs) {
  std::vector<StepId> steps;
  std::vector<JobId> turns;
  for (JobId id : jobs) {
    steps.push_back(only_step(id));
    turns.push_back(at(id).job->turn);
  }
  queues_.put_in_order(at(jobs.front()), steps);
  std::ranges::sort(turns);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    change(at(jobs[i])).turn = turns[i];
    explain_with_next(at(jobs[i]));
  }
}

void JobBook::take(Step& step, TrajectoryPtr trajectory, WaitingLeg leg, std::size_t place) {
  explain_with_next(step);
  queues_.erase(step);
  step.trajectory = std::move(trajectory);
  leg.motion = step.leg.motion + 1;
  step.leg = std::move(leg);
  queues_.insert_at(step, place);
  explain_with_next(step);
}

void JobBook::set_motion(Step& step, TrajectoryPtr trajectory, WaitingLeg leg) {
  queues_.remove_work(step);
  step.trajectory = std::move(trajectory);
  leg.motion = step.leg.motion + 1;
  step.leg = std::move(leg);
  if (!step.is_unplanned()) ++changes_;
  step.asking.effort = 1;
  step.asking.raised = 0;
  if (auto* queued = std::get_if<Queued>(&step.phase)) queued->judgement = {};
  queues_.add_work(step);
  explain_with_next(step);
  changed(step);
}

void JobBook::set_priority(Step& step, int priority) {
  const int now = step.job->terms.priority;
  if (--priorities_.at(now) == 0) priorities_.erase(now);
  change(step).terms.priority = priority;
  ++priorities_[priority];
  ++changes_;
  changed(step);
}

void JobBook::set_alternative(Step& step, std::size_t which, TrajectoryPtr trajectory,
                              WaitingLeg leg) {
  const bool is_taken = step.trajectory == step.alternatives[which];
  queues_.remove_work(step);
  step.alternatives[which] = trajectory;
  queues_.add_work(step);
  if (is_taken) set_motion(step, std::move(trajectory), std::move(leg));
}

void JobBook::decide_arm(Step& step) {
  queues_.remove_work(step);
  step.alternatives.clear();
  queues_.add_work(step);
  undecided_.erase(step.id.job);
  ++changes_;
  changed(step);
}

bool JobBook::set_planned(Step& step, bool is_planned) {
  const bool is_news = std::exchange(step.goal->is_planned, is_planned) != is_planned;
  if (is_news) ++changes_;
  return is_news;
}

void JobBook::put_in_question(Step& step) {
  step.asking.is_in_question = true;
  ++changes_;
}

// What comes next on its arms may have waited for it, or does now.
void JobBook::explain_with_next(const Step& step) {
  news_.unexplained.insert(step.id.job);
  for (ArmId arm : step.trajectory->arms()) {
    if (const auto next = queues_.behind(step, arm)) news_.unexplained.insert(next->job);
  }
}

void JobBook::enter(Step& step, StepPhase phase) {
  const JobId id = step.id.job;
  if (!leads_to(step.phase, phase)) {
    throw std::logic_error("job " + std::to_string(id.value()) + ": no transition from phase " +
                           std::to_string(step.phase.index()) + " to " +
                           std::to_string(phase.index()));
  }
  const bool is_dispatch = step.in<Admitted>() != nullptr && std::holds_alternative<Moving>(phase);
  if (step.phase.index() != phase.index() && !is_dispatch) ++changes_;
  if (!step.alternatives.empty()) queues_.remove_work(step);
  step.phase = std::move(phase);
  if (!step.alternatives.empty()) queues_.add_work(step);
  const bool is_decided = step.alternatives.empty() || step.in<Queued>() == nullptr;
  is_decided ? (void)undecided_.erase(id) : (void)undecided_.insert(id);
  const auto place = std::ranges::lower_bound(past_queue_, id);
  const bool was_past = place != past_queue_.end() && *place == id;
  const bool is_past = step.state() != JobState::queued && !step.has_ended();
  if (was_past && !is_past) past_queue_.erase(place);
  if (is_past && !was_past) past_queue_.insert(place, id);
  explain_with_next(step);
}

std::vector<JobId> JobBook::end(Step& step, Ended how) {
  enter(step, std::move(how));
  const JobId id = step.id.job;
  const Ended& ended = *step.in<Ended>();
  if (ended.reason != Reason::deadlock && !step.job->ring.empty()) change(step).ring.clear();
  if (ended.state != JobState::expired) step.waits_on.clear();  // else: what it waited for in vain
  if (ended.state == JobState::succeeded) step.progress = step.trajectory->duration();
  queues_.erase(step);
  queues_.remove_work(step);
  active_.erase(id);
  if (step.goal) --goals_;
  news_.unexplained.erase(id);
  const int priority = step.job->terms.priority;
  if (--priorities_.at(priority) == 0) priorities_.erase(priority);
  changed(step);
  const auto node = followers_.extract(id);
  return node.empty() ? std::vector<JobId>{} : node.mapped();
}

void JobBook::set_waits(Step& step, std::span<const Wait> waits) {
  auto& old = step.waits_on;
  if (std::ranges::equal(old, waits)) return;
  const bool same =
      std::ranges::equal(old, waits, [](const Wait& a, const Wait& b) { return a.same_cause(b); });
  old.assign(waits.begin(), waits.end());
  if (!same) changed(step);
}

std::vector<const Step*> occupying(const JobBook& book) {
  std::vector<const Step*> steps;
  for (JobId id : book.past_queue()) {
    const Step& step = book.at(id);
    if (step.in<Held>() != nullptr || step.has_authority()) steps.push_back(&step);
  }
  return steps;
}

bool lets_another_pass(const JobBook& book, const Step& step) {
  const auto& other = step.job->errand.lets_pass;
  return other && book.is_active(*other) && book.at(*other).is_waiting();
}

// Sorts by turn, but keeps the order of each arm's queue. An errand (Errand::before) counts with
// the turn of the first job behind it in the queue that is no errand.
std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs) {
  std::map<JobId, JobId> behind;  // of an errand: the job whose turn counts
  for (const auto& queue : book.queues()) {
    std::optional<JobId> first;
    for (auto step = queue.rbegin(); step != queue.rend(); ++step) {
      if (!book.at(*step).job->errand.before) {
        first = step->job;
      } else if (first) {
        behind.emplace(step->job, *first);
      }
    }
  }
  std::vector<JobId> by_turn(jobs.begin(), jobs.end());
  const auto turn = [&](JobId id) { return book.at(id).job->turn; };
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

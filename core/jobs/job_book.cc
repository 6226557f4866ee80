#include "core/jobs/job_book.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace armloom {
namespace {

// The table in step.h, with changes of data within a phase.
bool leads_to(const StepPhase& from, const StepPhase& to) {
  static constexpr bool kTable[][6] = {
      // to: Queued, Admitted, Moving, Braking, Held, Ended
      {true, true, false, false, false, true},     // Queued
      {true, true, true, false, true, true},       // Admitted
      {false, true, true, true, true, true},       // Moving
      {true, true, false, true, true, true},       // Braking
      {true, true, false, false, true, true},      // Held
      {false, false, false, false, false, false},  // Ended
  };
  return kTable[from.index()][to.index()];
}

}  // namespace

void JobIds::take(JobId id) {
  std::uint64_t& last = id.value() < first_ ? last_former_ : last_;
  if (id.value() <= last) throw std::invalid_argument("Submit: ids must grow");
  last = id.value();
}

const Step& JobBook::add(Step step) {
  const JobId id = step.id.job;
  ids_.take(id);
  const auto& before = step.job->errand.before;
  queues_.insert(step, before ? std::optional(only_step(*before)) : std::nullopt);
  queues_.add_work(step);
  active_.add(step);
  updates_.explain(id);
  if (before) updates_.explain(*before);
  updates_.publish(id);
  return steps_.emplace(step.id, std::move(step)).first->second;
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
    change(steps_.at(steps[i])).turn = turns[i];
    explain_with_next(at(jobs[i]));
  }
}

void JobBook::take(const Step& step, std::size_t which, WaitingLeg leg, std::size_t place) {
  Step& own = edit(step);
  explain_with_next(own);
  queues_.erase(own);
  own.trajectory = own.alternatives[which];
  if (own.goal) own.goal->taken = which;
  leg.motion = own.leg.motion + 1;
  own.leg = std::move(leg);
  queues_.insert_at(own, place);
  explain_with_next(own);
}

void JobBook::set_motion(const Step& step, TrajectoryPtr trajectory, WaitingLeg leg) {
  Step& own = edit(step);
  queues_.remove_work(own);
  own.trajectory = std::move(trajectory);
  leg.motion = own.leg.motion + 1;
  own.leg = std::move(leg);
  if (!own.is_unplanned()) ++changes_;
  own.asking.effort = 1;
  own.asking.raised = 0;
  if (auto* queued = std::get_if<Queued>(&own.phase)) queued->judgement = {};
  queues_.add_work(own);
  explain_with_next(own);
  changed(own);
}

void JobBook::set_alternative(const Step& step, std::size_t which, TrajectoryPtr trajectory,
                              WaitingLeg leg) {
  const bool is_taken = step.trajectory == step.alternatives[which];
  queues_.remove_work(step);
  edit(step).alternatives[which] = trajectory;
  queues_.add_work(step);
  if (is_taken) set_motion(step, std::move(trajectory), std::move(leg));
}

void JobBook::decide_arm(const Step& step) {
  queues_.remove_work(step);
  edit(step).alternatives.clear();
  queues_.add_work(step);
  active_.follow(step);
  ++changes_;
  changed(step);
}

bool JobBook::set_planned(const Step& step, bool is_planned) {
  if (step.goal->is_planned == is_planned) return false;
  edit(step).goal->is_planned = is_planned;
  ++changes_;
  return true;
}

void JobBook::amend(const Step& step, AmendedTerms terms) {
  JobTerms& own = change(edit(step)).terms;
  const int before = own.priority;
  apply(terms, own);
  changed(step);
  if (own.priority == before) return;
  active_.change_priority(before, own.priority);
  ++changes_;
}

void JobBook::put_in_backlog(const Step& step, TimePoint now, TimePoint clock) {
  const auto* queued = step.in<Queued>();
  if (queued == nullptr || queued->in_backlog) return;
  enter(step, Queued{.in_backlog = true, .judgement = queued->judgement});
  if (step.times.backlogged_at) return;
  edit(step).times.backlogged_at = now;
  edit(step).times.backlog_clock = clock;
}

void JobBook::leave_backlog(const Step& step) {
  const auto* queued = step.in<Queued>();
  if (queued == nullptr || !queued->in_backlog) return;
  enter(step, Queued{});
  edit(step).times.backlogged_at.reset();
}

void JobBook::start(const Step& step, TimePoint now) {
  Step& own = edit(step);
  const JobState before = own.state();
  own.note_start(now);
  if (auto* moving = std::get_if<Moving>(&own.phase)) moving->is_under_way = true;
  auto* braking = std::get_if<Braking>(&own.phase);
  if (braking != nullptr && before == JobState::scheduled) braking->state = JobState::running;
  if (own.state() != before) changed(own);
}

void JobBook::schedule(const Step& step, std::optional<TimePoint> at) {
  if (step.in<Admitted>() != nullptr && step.times.scheduled_at != at) changed(step);
  edit(step).times.scheduled_at = at;
}

void JobBook::measure(const Step& step, const MotionReport& report, TimePoint now) {
  Step& own = edit(step);
  own.progress = report.progress;
  own.times.measured_at = now;
  auto* braking = std::get_if<Braking>(&own.phase);
  if (report.kind != MotionReport::Kind::progressed) {
    own.farthest = report.farthest;
  } else if (braking != nullptr) {
    braking->rests_at = report.rests_at;
  }
}

void JobBook::start_over(const Step& step) {
  Step& own = edit(step);
  own.times.backlogged_at.reset();
  own.times.scheduled_at.reset();
  own.times.motion_started_at.reset();
  own.progress = Duration{};
  own.farthest = Duration{};
}

// The next jobs of its arms may have waited for it, or do so now.
void JobBook::explain_with_next(const Step& step) {
  explain(step);
  for (ArmId arm : step.trajectory->arms()) {
    if (const auto next = queues_.behind(step, arm)) updates_.explain(next->job);
  }
}

void JobBook::enter(const Step& step, StepPhase phase) {
  if (!leads_to(step.phase, phase)) {
    throw std::logic_error("job " + std::to_string(step.id.job.value()) +
                           ": no transition from phase " + std::to_string(step.phase.index()) +
                           " to " + std::to_string(phase.index()));
  }
  Step& own = edit(step);
  const bool is_dispatch = step.in<Admitted>() != nullptr && std::holds_alternative<Moving>(phase);
  const bool is_other = step.phase.index() != phase.index() && !is_dispatch;
  const bool was_queued = step.in<Queued>() != nullptr;
  const JobState before = step.state();
  if (!step.alternatives.empty()) queues_.remove_work(step);
  own.phase = std::move(phase);
  if (!step.alternatives.empty()) queues_.add_work(step);
  if (is_other) ++changes_;
  if (is_other || step.in<Braking>() != nullptr || step.state() != before) changed(step);
  if (was_queued && step.in<Admitted>() != nullptr) {
    own.waits_on.clear();
    own.starvation.reset();
    own.asking.effort = 1;
  }
  active_.follow(step);
  explain_with_next(step);
}

std::vector<JobId> JobBook::end(const Step& step, Ended how) {
  enter(step, std::move(how));
  Step& own = edit(step);
  const JobId id = step.id.job;
  const Ended& ended = *step.in<Ended>();
  if (ended.reason != Reason::deadlock && !step.job->ring.empty()) change(own).ring.clear();
  if (ended.state != JobState::expired) own.waits_on.clear();  // otherwise they tell why it expired
  if (ended.state == JobState::succeeded) own.progress = own.trajectory->duration();
  queues_.erase(step);
  queues_.remove_work(step);
  being_replanned_.erase(id);
  updates_.end(id);
  std::vector<JobId> followers = active_.end(step);
  std::erase_if(followers, [&](JobId follower) {
    const bool waits =
        active_.contains(follower) && std::ranges::count(at(follower).job->after, id) > 0;
    return !waits || std::erase(change(steps_.at(only_step(follower))).after, id) == 0;
  });
  return followers;
}

std::vector<const Step*> occupying(const JobBook& book) {
  std::vector<const Step*> steps;
  for (const Step& step : book.past_queue()) {
    if (step.in<Held>() != nullptr || step.has_authority()) steps.push_back(&step);
  }
  return steps;
}

bool lets_another_pass(const JobBook& book, const Step& step) {
  const auto& other = step.job->errand.lets_pass;
  return other && book.active().contains(*other) && book.at(*other).is_waiting();
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

// Policies that coordinate: passing orders instead of times, held by authority over progress.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/scheduler/scheduler.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

// What an arm may be granted beyond its stopping distance: so long it goes on at full speed without
// a word from here, and so far others cannot be let pass before it.
constexpr Duration kHorizon = std::chrono::milliseconds(250);
// Authority is extended by no less than this, but for the last bit.
constexpr Duration kGrantStep = std::chrono::milliseconds(80);
// So many jobs that wait are tried as one at most, lest a decision take long.
constexpr std::size_t kTogetherMax = 16;
// Nearer than this to its limit, a motion has come to it.
constexpr Duration kAtLimit = std::chrono::milliseconds(2);

Wait wait_for(const HeldBack& held) {
  return Wait{.kind = held.by ? Wait::Kind::job : Wait::Kind::arm,
              .job = held.by,
              .arm = held.arm ? held.arm : held.proximity.arm_b,
              .proximity = held.proximity,
              .own_time = held.own_time,
              .other_time = held.other_time};
}

Wait wait_for(const Obstacle& obstacle) {
  return wait_for(HeldBack{obstacle.other, obstacle.arm, obstacle.proximity, obstacle.own_time,
                           obstacle.other_time});
}

}  // namespace

Motion Scheduler::motion_now(const Record& record) const {
  const auto& arms = record.job.trajectory->arms();
  const bool to_come = std::ranges::any_of(
      arms, [&](ArmId arm) { return order_[arm.index()].front() != record.job.id; });
  return Motion{.job = record.job.id,
                .trajectory = record.job.trajectory,
                .progress = record.job.progress,
                .to_come = to_come};
}

CoordinatedMotion Scheduler::coordinated(const Record& record) const {
  return {.job = record.job.id,
          .arms = record.job.trajectory->arms(),
          .duration = record.job.trajectory->duration(),
          .progress = record.job.progress,
          .authority = record.job.progress,
          .priority = record.job.priority};
}

void Scheduler::add_others(Question& question, const std::vector<JobId>& candidates) const {
  for (const CoordinatedMotion& motion : graph_.motions()) {
    if (std::ranges::find(candidates, motion.job) != candidates.end()) continue;
    question.others.push_back(motion_now(records_.at(motion.job)));
  }
}

std::optional<Duration> Scheduler::earliest_start(const Question& question,
                                                  const Verdict& verdict) const {
  if (verdict.kind != Verdict::Kind::free || question.version != version_) return std::nullopt;
  if (question.candidates.size() != 1) return std::nullopt;
  const std::vector<CoordinatedMotion> candidate{
      coordinated(records_.at(question.candidates.front().job))};
  const PassingOrders orders =
      orders_in_time(graph_.question(candidate, verdict.regions), std::nullopt);
  if (!orders.obstacles.empty()) return std::nullopt;
  return orders.prediction.begins.back();
}

// ---- The answer ----

void Scheduler::answer(const Verdict& verdict, const OpenQuestion& question) {
  Record& first = records_.at(question.jobs.front());
  const bool recheck = question.purpose == Purpose::recheck;
  if (verdict.kind != Verdict::Kind::free) {
    if (!recheck && is_asked_again(first, verdict)) return;
    if (!recheck && question.jobs.size() > 1 && tries_together(question, false)) return;
    if (question.jobs.size() == 1) {
      refuse(first, verdict, recheck);
    } else {
      put_off(first, first.found);  // one that was to help it cannot go
    }
    return;
  }
  if (recheck) {
    first.checked_at = version_;
    return;
  }
  if (graph_.holds(first.job.id)) {  // was stopped on its way; its orders stand
    std::vector<Wait> waits;
    for (const PairRegions& pair : verdict.regions) {
      if (const auto* arm = std::get_if<ArmId>(&pair.b)) {
        const ConflictRegion& region = pair.regions.front();
        waits.push_back(wait_for(Obstacle{first.job.id, std::nullopt, *arm, region.proximity,
                                          region.time_a, region.time_b}));
      }
    }
    if (!waits.empty()) return put_off(first, std::move(waits));
    set_state(first, JobState::scheduled);
    first.job.scheduled_at = now_;
    first.dispatched = false;
    first.checked_at = ++version_;
    changed(first);
    return;
  }
  std::vector<CoordinatedMotion> candidates;
  std::vector<Duration> work_behind = work_;
  std::vector<JobId> in_front = question.jobs;
  for (const CoordinatedMotion& motion : graph_.motions()) {
    const auto& ages_from = records_.at(motion.job).ages_from;
    if (ages_from && now_ - *ages_from >= cell_->scheduling.aging) graph_.keep_place(motion.job);
    in_front.push_back(motion.job);
  }
  for (JobId id : in_front) {
    const Trajectory& trajectory = *records_.at(id).job.trajectory;
    for (ArmId arm : trajectory.arms()) work_behind[arm.index()] -= trajectory.duration();
  }
  for (JobId id : question.jobs) candidates.push_back(coordinated(records_.at(id)));
  graph_.set_work_behind(std::move(work_behind));
  const PassingOrders orders = policy_->decide(graph_.question(candidates, verdict.regions));
  if (tries_together(question, orders.obstacles.empty())) return;
  if (orders.obstacles.empty()) {
    if (!leaves_a_sequence(question.jobs)) {
      if (!open_) (void)tries_together(question, false);
      return;
    }
    sequence_.admitted(question.jobs);
    graph_.admit(candidates, orders);
    admit(question.jobs, orders);
    return;
  }
  std::vector<Wait> waits;
  for (const Obstacle& obstacle : orders.obstacles) {
    if (obstacle.candidate != first.job.id) continue;
    if (obstacle.arm) learn_in_the_way(first.job.id, *obstacle.arm);
    waits.push_back(wait_for(obstacle));
  }
  if (question.jobs.size() == 1 || !waits.empty()) first.found = std::move(waits);
  const std::vector<JobId> group = with_next_jobs(question.jobs, orders.in_the_way);
  if (group.size() > question.jobs.size()) {
    ask(group, Purpose::start);
  } else if (!is_asked_again(first, verdict)) {
    put_off(first, first.found);
  }
}

// For some of what waits there is no order one by one, whether these go or not: all are tried as
// one; where that fails too, these go alone. Whether something else is asked now.
bool Scheduler::tries_together(const OpenQuestion& question, bool can_go) {
  if (!policy_->admits_groups()) return false;
  const bool tried = together_ && together_->version == version_;
  if (!can_go) {
    if (!tried || together_->alone.empty()) return false;
    ask(std::exchange(together_->alone, {}), Purpose::start);
    return true;
  }
  if (tried) return false;
  const auto outlook = outlook_after(question.jobs);
  if (!outlook.ahead.empty()) {  // others have come meanwhile
    ask(question.jobs, Purpose::start);
    return true;
  }
  if (outlook.all) return false;
  std::vector<JobId> all = with_all_that_wait(question.jobs);
  if (all.size() == question.jobs.size() || all.size() > kTogetherMax) return false;
  together_ = Together{version_, question.jobs};
  ask(std::move(all), Purpose::start);
  return true;
}

// Of each arm's jobs that are not admitted or in the group the first ones.
std::set<JobId> Scheduler::first_of_arms(const std::vector<JobId>& group) const {
  std::set<JobId> jobs;
  for (const auto& queue : order_) {
    std::size_t left = kTogetherMax;
    for (auto id = queue.begin(); id != queue.end() && left > 0; ++id) {
      if (graph_.holds(*id) || std::ranges::find(group, *id) != group.end()) continue;
      jobs.insert(*id);
      --left;
    }
  }
  return jobs;
}

// At most so many of an arm, each after those before it; without what comes after other jobs or is
// stopped, and without what is behind that on its arms.
std::vector<JobId> Scheduler::with_all_that_wait(const std::vector<JobId>& group) const {
  std::vector<JobId> all = group;
  std::vector<std::size_t> left(order_.size(), kTogetherMax);
  for (JobId id : in_turn(first_of_arms(group))) {
    const Record& record = records_.at(id);
    const auto& arms = record.job.trajectory->arms();
    const bool room = std::ranges::all_of(arms, [&](ArmId arm) { return left[arm.index()] > 0; });
    const bool goes = room && may_follow(record);
    if (goes) all.push_back(id);
    for (ArmId arm : arms) left[arm.index()] = goes ? left[arm.index()] - 1 : 0;
  }
  return all;
}

void Scheduler::admit(const std::vector<JobId>& jobs, const PassingOrders& orders) {
  ++version_;
  const std::size_t before = graph_.motions().size() - jobs.size();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    Record& record = records_.at(jobs[i]);
    Job& job = record.job;
    set_state(record, JobState::scheduled);
    job.scheduled_at = now_ + orders.prediction.begins[before + i];
    job.waits_on.clear();
    record.after_stop = AfterStop::hold;
    record.judged_at = 0;
    record.checked_at = version_;
    record.effort = 1;
    record.dispatched = false;
    record.horizon = from_seconds(stopping_reach_s(*cell_, *job.trajectory)) +
                     cell_->monitor.reaction + kHorizon;
    if (!record.ages_from) record.ages_from = now_;
    changed(record);
  }
}

// Of each arm in the way the first job that is not in the group, if that could go too.
std::vector<JobId> Scheduler::with_next_jobs(const std::vector<JobId>& group,
                                             const std::vector<ArmId>& in_the_way) const {
  std::vector<JobId> larger = group;
  if (!policy_->admits_groups()) return larger;
  const auto goes = [&](JobId id) {
    return graph_.holds(id) || std::ranges::find(larger, id) != larger.end();
  };
  for (ArmId arm : in_the_way) {
    const auto& queue = order_[arm.index()];
    const auto next = std::ranges::find_if_not(queue, goes);
    if (next == queue.end() || larger.size() >= 2 * order_.size()) continue;
    const Record& record = records_.at(*next);
    if (!may_follow(record)) continue;
    const bool is_next = std::ranges::all_of(record.job.trajectory->arms(), [&](ArmId own) {
      return *std::ranges::find_if_not(order_[own.index()], goes) == *next;
    });
    if (is_next) larger.push_back(*next);
  }
  return larger;
}

// It could go when those before it on its arms have gone.
bool Scheduler::may_follow(const Record& record) const {
  return waiting(record) && record.job.after.empty() && !lets_another_pass(record) &&
         !stop_of(record) && sequence_.follows_on(record.job.id);
}

// ---- Authority ----

// What is admitted starts when precedence lets it leave its place.
void Scheduler::dispatch_ready() {
  const std::vector<JobId> ids(past_queue_.begin(), past_queue_.end());
  for (JobId id : ids) {
    Record& record = records_.at(id);
    if (record.job.state == JobState::scheduled && !record.dispatched) {
      dispatch_if_ready(record);
    } else {
      extend_own_authority(record);
    }
    if (record.job.pausing) explain_pause(record);
  }
}

void Scheduler::explain_pause(Record& record) {
  if (const auto held = graph_.held_back(record.job.id)) set_waits(record, {wait_for(*held)});
}

// What keeps an admitted job from going on, or from beginning; nothing: it goes, or is about to.
std::optional<Wait> Scheduler::held_where_it_stands(const Record& record) const {
  if (waiting(record) || record.job.stopping) return std::nullopt;
  const bool not_told = record.job.state == JobState::scheduled && !record.dispatched;
  if (!not_told && !record.job.pausing) return std::nullopt;
  if (graph_.limit(record.job.id) > record.job.progress + kAtLimit) return std::nullopt;
  const auto held = graph_.held_back(record.job.id);
  return held ? std::optional(wait_for(*held)) : std::nullopt;
}

// It moves only after others have moved.
bool Scheduler::stands(const Record& record) const {
  const bool behind = record.job.state == JobState::scheduled && !at_head(record);
  return waiting(record) || behind || held_where_it_stands(record).has_value();
}

void Scheduler::dispatch_if_ready(Record& record) {
  Job& job = record.job;
  if (!at_head(record)) return;
  if (!job.started_at && start_mismatch(*job.trajectory)) return withdraw(record, AfterStop::hold);
  if (stop_of(record) || record.checked_at < disturbed_at_) return;
  const Duration limit = graph_.limit(job.id);
  if (limit <= job.progress && job.progress < job.trajectory->duration()) {
    const auto held = graph_.held_back(job.id);
    if (held && held->arm && !job.started_at) return withdraw(record, AfterStop::hold);
    if (job.started_at && !job.pausing) {  // stopped on its way: it pauses there until it may go on
      job.pausing = true;
      changed(record);
    }
    explain_pause(record);
    return;
  }
  job.pausing = false;
  const Duration authority = std::min(limit, job.progress + record.horizon);
  graph_.granted(job.id, authority);
  record.dispatched = true;
  job.scheduled_at = now_;
  expect_end(record, now_);
  set_waits(record, {});
  effects_.push_back(Dispatch{job.id, now_, job.progress, authority});
}

// A motion has moved: it may have made way for others, and may go on itself.
void Scheduler::extend_authority(JobId moved) {
  extend_own_authority(records_.at(moved));
  std::vector<JobId> behind;
  for (const Precedence& precedence : graph_.precedences()) {
    if (precedence.first() == moved) behind.push_back(precedence.second());
  }
  for (JobId id : behind) {
    Record& record = records_.at(id);
    if (record.job.state == JobState::scheduled && !record.dispatched) {
      dispatch_if_ready(record);
    } else {
      extend_own_authority(record);
    }
  }
}

void Scheduler::extend_own_authority(Record& record) {
  const bool in_motion =
      record.dispatched && !record.job.stopping &&
      (record.job.state == JobState::scheduled || record.job.state == JobState::running);
  if (!in_motion) return;
  const JobId job = record.job.id;
  const Duration limit = graph_.limit(job);
  const Duration authority = std::min(limit, record.job.progress + record.horizon);
  const Duration granted = graph_.find(job)->authority;
  if (authority <= granted || (authority < granted + kGrantStep && authority < limit)) return;
  graph_.granted(job, authority);
  effects_.push_back(Grant{job, authority});
}

// At rest at its limit a running motion pauses; what it loses there is no overrun.
void Scheduler::see_pauses(Record& record, Duration progress_before) {
  Job& job = record.job;
  if (job.state != JobState::running || job.stopping) return;
  const Duration limit = graph_.limit(job.id);
  if (limit < job.trajectory->duration() && job.progress + record.horizon >= limit) {
    expect_end(record, now_);
  }
  const bool at_limit = limit < job.trajectory->duration() && job.progress + kAtLimit >= limit;
  if (job.progress > progress_before) {
    if (!job.pausing) return;
    job.pausing = false;
    set_waits(record, {});
    changed(record);
  } else if (at_limit && !job.pausing) {
    job.pausing = true;
    explain_pause(record);
    changed(record);
  }
}

// Its motion is admitted no more: it rests where it is. Nor are those behind it on its arms, which
// begin where it would have ended.
void Scheduler::leave_graph(const Record& record) {
  if (!graph_.holds(record.job.id)) return;
  std::set<JobId> behind;
  for (ArmId arm : record.job.trajectory->arms()) {
    const auto& queue = order_[arm.index()];
    const auto own = std::ranges::find(queue, record.job.id);
    if (own == queue.end()) continue;
    for (auto next = own + 1; next != queue.end(); ++next) {
      if (graph_.holds(*next)) behind.insert(*next);
    }
  }
  for (auto job = behind.rbegin(); job != behind.rend(); ++job) {
    if (graph_.holds(*job)) withdraw(records_.at(*job), AfterStop::hold);
  }
  graph_.abandon(record.job.id, record.job.progress, record.farthest);
}

}  // namespace armloom

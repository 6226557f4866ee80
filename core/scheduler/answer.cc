// What an answer means: these go, with these orders; or more is asked; or they wait.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "core/coordination/effort.h"
#include "core/scheduler/scheduler.h"
#include "core/scheduler/waits.h"
#include "core/trajectory/stopping_reach.h"

namespace armloom {
namespace {

// What an arm may be granted beyond its stopping distance: so long it goes on at full speed without
// a word from here, and so far others cannot be let pass before it.
constexpr Duration kHorizon = std::chrono::milliseconds(250);
// So many jobs that wait are tried as one at most, lest a decision take long.
constexpr std::size_t kTogetherMax = 16;
// What a job waits for that is treated as a conflict without being proven one.
constexpr const char* kUndecided = "undecided within the budget of evaluations";
// So often is the budget of one job's questions raised.
constexpr int kRaisedMax = 12;

std::string hits_itself(const Conflict& conflict) {
  char text[128];
  std::snprintf(text, sizeof text, " come within %.4g m of each other at %.3f s of the trajectory",
                conflict.proximity.clearance_m, to_seconds(conflict.own_time));
  return conflict.proximity.body_a + " and " + conflict.proximity.body_b + text;
}

}  // namespace

void Scheduler::on(const Judged& input) {
  if (!open_ || open_->version != input.verdict.version) return;
  const OpenQuestion question = std::move(*open_);
  open_.reset();
  learn(question, input.verdict);
  if (question.version != version_) return;  // stale: settle() asks again
  if (question.aside) return answer_aside(input.verdict, *question.aside);
  answer(input.verdict, question);
}

CoordinatedMotion Scheduler::coordinated(const Record& record) const {
  return {.job = record.job.id,
          .arms = record.job.trajectory->arms(),
          .duration = record.job.trajectory->duration(),
          .progress = record.job.progress,
          .authority = record.job.progress,
          .priority = record.job.priority};
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

// ---- They wait ----

// Where the budget of evaluations has ended it is not put off yet, but judged again with a larger
// one when its turn comes, behind those that are judged with less. So often at most that a job that
// cannot be decided takes no time from others each time that something changes.
bool Scheduler::is_asked_again(Record& record, const Verdict& verdict) const {
  const auto effort = larger_effort(verdict, record.effort);
  if (!effort || record.raised >= kRaisedMax) {
    record.effort = 1;
    return false;
  }
  record.effort = *effort;
  ++record.raised;
  return true;
}

void Scheduler::refuse(Record& record, const Verdict& verdict, bool recheck) {
  Job& job = record.job;
  std::vector<Wait> waits;
  for (const Conflict& conflict : verdict.conflicts) {
    if (conflict.with == Conflict::With::self && !job.started_at) {
      end(record, JobState::failed, Reason::self_collision, hits_itself(conflict));
      return;
    }
    if (conflict.with == Conflict::With::rest && conflict.proximity.arm_b) {
      learn_in_the_way(job.id, *conflict.proximity.arm_b);
    }
    waits.push_back(wait_for(conflict));
    if (verdict.kind == Verdict::Kind::undecided) waits.back().detail = kUndecided;
  }
  if (recheck) {
    record.checked_at = version_;
    brake(record, AfterStop::hold);
    set_waits(record, std::move(waits));
  } else {
    put_off(record, std::move(waits));
  }
}

void Scheduler::put_off(Record& record, std::vector<Wait> waits) {
  Job& job = record.job;
  record.judged_at = version_;
  record.found = waits;
  if (!record.ages_from) record.ages_from = now_;
  if (job.state == JobState::queued) {
    set_state(record, JobState::backlogged);
    if (!job.backlogged_at) job.backlogged_at = now_;
    changed(record);
  }
  set_waits(record, std::move(waits));
}

}  // namespace armloom

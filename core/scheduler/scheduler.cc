#include "core/scheduler/scheduler.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

std::string seconds_text(Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g s", to_seconds(duration));
  return text;
}

}  // namespace

Scheduler::Scheduler(CellPtr cell, std::unique_ptr<const Policy> policy, Configuration rest)
    : cell_(std::move(cell)),
      policy_(std::move(policy)),
      rest_(std::move(rest)),
      work_(cell_->arms.size()),
      order_(cell_->arms.size()),
      stopped_(cell_->arms.size()),
      came_by_(cell_->arms.size()),
      rests_at_(cell_->arms.size()),
      sequence_(cell_->execution.start_tolerance_rad),
      graph_(cell_->arms.size()) {
  if (!policy_) throw std::invalid_argument("Scheduler: no policy");
  if (rest_.size() != static_cast<Eigen::Index>(cell_->joints.size())) {
    throw std::invalid_argument("Scheduler: rest has another size than the cell has joints");
  }
  for (std::uint32_t arm = 0; arm < rests_at_.size(); ++arm) rest_where_it_stands(ArmId{arm});
}

std::vector<Effect> Scheduler::step(const Input& input, TimePoint now) {
  if (now < now_) throw std::invalid_argument("Scheduler: time went backwards");
  now_ = now;
  const auto* report = std::get_if<MotionReport>(&input);
  const Version version_before = version_;
  std::visit([this](const auto& i) { on(i); }, input);

  // Progress alone, the bulk of all inputs, changes nothing that others wait for.
  const bool only_progress = report && report->kind == MotionReport::Kind::progressed &&
                             changed_.empty() && version_ == version_before &&
                             !(wake_at_ && *wake_at_ <= now_);
  if (!only_progress) settle();

  // What clients see comes first, so that an event is told before its consequences.
  std::vector<Effect> result;
  result.reserve(changed_.size() + effects_.size());
  for (JobId job : changed_) result.push_back(JobChanged{job});
  std::move(effects_.begin(), effects_.end(), std::back_inserter(result));
  changed_.clear();
  effects_.clear();
  return result;
}

void Scheduler::settle() {
  expire_and_overrun();
  settle_deadlocks();
  dispatch_ready();
  fail_impossible_starts();
  bool put_off = true;
  while (put_off) {  // until a question is open, or nothing is left to be asked
    form_round();
    explain_waits();
    name_deadlocks();
    put_off = ask_next();
  }
  ask_for_wake();
}

const Job* Scheduler::find(JobId job) const {
  const auto it = records_.find(job);
  return it == records_.end() ? nullptr : &it->second.job;
}

std::vector<JobId> Scheduler::active() const { return {active_.begin(), active_.end()}; }

bool Scheduler::stopped(ArmId arm) const { return stopped_[arm.index()].has_value(); }

std::optional<JobId> Scheduler::occupant(ArmId arm) const {
  const auto& queue = order_[arm.index()];
  if (queue.empty()) return std::nullopt;
  const Record& head = records_.at(queue.front());
  const bool ahead = head.job.state == JobState::scheduled && !head.dispatched;
  const bool in_motion = (holds_reservation(head) && !ahead) || head.job.state == JobState::holding;
  return in_motion ? std::optional(queue.front()) : std::nullopt;
}

void Scheduler::forget(JobId ended) {
  const auto it = records_.find(ended);
  if (it != records_.end() && is_terminal(it->second.job.state)) records_.erase(it);
}

void Scheduler::on(const Submit& input) {
  if (!input.trajectory) throw std::invalid_argument("Submit: no trajectory");
  if (!records_.empty() && input.job <= records_.rbegin()->first) {
    throw std::invalid_argument("Submit: ids must grow");
  }
  Job job{.id = input.job,
          .trajectory = input.trajectory,
          .priority = input.priority,
          .backlog_timeout = input.backlog_timeout,
          .after = input.after,
          .own = input.own,
          .submitted_at = now_};
  WaitingLeg leg = leg_of(job);
  Record record{.job = std::move(job), .leg = std::move(leg)};
  const bool known = input.helps && records_.contains(*input.helps);
  record.helps = known ? records_.at(*input.helps).helps : input.job;
  record.before = input.before;
  record.lets_pass = input.lets_pass;
  for (ArmId arm : input.trajectory->arms()) {
    auto& queue = order_[arm.index()];
    queue.insert(input.before ? std::ranges::find(queue, *input.before) : queue.end(), input.job);
    work_[arm.index()] += input.trajectory->duration();
  }
  active_.insert(input.job);
  unexplained_.insert(input.job);
  ++priorities_[input.priority];
  for (JobId before : input.after) followers_[before].push_back(input.job);
  if (input.before) lanes_changed_ = true;
  if (!lanes_changed_) {
    record.leg.after = input.after;
    sequence_.append(record.leg);
  }
  changed(records_.emplace(input.job, std::move(record)).first->second);
  if (input.before) take_place(input.job, *input.before);
}

// Before a job that was in a ring: an arm of that goes aside now.
void Scheduler::take_place(JobId job, JobId before) {
  const bool is_judged = open_ && std::ranges::find(open_->jobs, before) != open_->jobs.end();
  if (is_judged) ++version_;  // the answer shall not start what comes behind it
  unexplained_.insert(before);
  if (round_.contains(before)) round_.insert(job);
  std::erase_if(rings_, [&](const NamedRing& named) {
    const bool opened = std::ranges::find(named.ring, before) != named.ring.end();
    if (opened) untell(named.ring);
    return opened;
  });
}

void Scheduler::on(const Cancel& input) {
  const auto it = records_.find(input.job);
  if (it == records_.end() || is_terminal(it->second.job.state)) return;
  Record& record = it->second;
  if (holds_reservation(record)) {
    brake(record, AfterStop::cancel);
    return;
  }
  const bool held = record.job.state == JobState::holding;
  end(record, JobState::canceled, Reason::canceled_by_client,
      held ? "canceled while holding" : "canceled before it moved");
  if (held) effects_.push_back(Release{input.job});
}

void Scheduler::on(const MotionReport& input) {
  const auto it = records_.find(input.job);
  if (it == records_.end() || is_terminal(it->second.job.state)) return;
  Record& record = it->second;
  const Duration before = std::exchange(record.job.progress, input.progress);
  record.job.progress_seen_at = now_;
  if (input.progress > before) record.moved_at = now_;
  graph_.progress(record.job.id, input.progress);
  see_pauses(record, before);
  if (input.kind == MotionReport::Kind::progressed) {
    progress(record);
  } else {
    come_to_rest(record, input);
  }
}

void Scheduler::progress(Record& record) {
  Job& job = record.job;
  if (job.state == JobState::scheduled) {
    set_state(record, JobState::running);
    if (!job.started_at) job.started_at = now_;
    changed(record);
  }
  if (!job.stopping) extend_authority(job.id);
}

void Scheduler::come_to_rest(Record& record, const MotionReport& report) {
  Job& job = record.job;
  const auto& joints = job.trajectory->joints();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    rest_[static_cast<Eigen::Index>(joints[j].index())] =
        report.rest_position[static_cast<Eigen::Index>(j)];
  }
  ++version_;
  const bool moved = std::max(job.progress, report.farthest) > Duration{};
  if (moved && !job.started_at) job.started_at = now_;  // unseen
  record.farthest = report.farthest;
  job.stopping = false;
  job.pausing = false;
  for (ArmId arm : job.trajectory->arms()) {
    rest_where_it_stands(arm);
    const bool alone = job.trajectory->arms().size() == 1;
    came_by_[arm.index()] = alone ? job.trajectory : nullptr;
  }
  record.overrun_at.reset();
  if (report.kind == MotionReport::Kind::finished) {
    rest_at_goal(record);
    end(record, JobState::succeeded, Reason::completed, "");
    effects_.push_back(Release{job.id});
    return;
  }
  if (report.kind == MotionReport::Kind::faulted) {
    for (ArmId arm : job.trajectory->arms()) stopped_[arm.index()] = "fault: " + report.detail;
    end(record, JobState::failed, Reason::arm_fault, report.detail);
    effects_.push_back(Release{job.id});
  } else if (record.after_stop == AfterStop::cancel) {
    end(record, JobState::canceled, Reason::canceled_by_client, "braked on its path");
    effects_.push_back(Release{job.id});
  } else if (record.after_stop == AfterStop::fail) {
    const bool expires = record.fail_reason == Reason::backlog_timeout;
    end(record, expires ? JobState::expired : JobState::failed, record.fail_reason,
        record.fail_detail);
    effects_.push_back(Release{job.id});
  } else if (!job.started_at) {
    record.dispatched = false;
    effects_.push_back(Release{job.id});
    changed(record);
    if (stop_of(record)) return;  // keeps its place between the others
    // It waits in the queue again, as if it had not been admitted.
    leave_graph(record);
    set_state(record, JobState::queued);
    job.scheduled_at.reset();
  } else {
    set_state(record, JobState::holding);
    changed(record);
  }
}

// A scheduled job whose arms know nothing of it yet: it waits again, or ends.
void Scheduler::withdraw(Record& record, AfterStop then) {
  ++version_;  // others may have counted on its departure
  record.job.pausing = false;
  if (then != AfterStop::hold) {
    const bool held = record.job.started_at.has_value();
    if (then == AfterStop::fail) {
      end(record, JobState::failed, record.fail_reason, record.fail_detail);
    } else {
      end(record, JobState::canceled, Reason::canceled_by_client,
          held ? "canceled while holding" : "canceled before it moved");
    }
    if (held) effects_.push_back(Release{record.job.id});
    return;
  }
  leave_graph(record);
  Job& job = record.job;
  set_state(record, job.started_at      ? JobState::holding
                    : job.backlogged_at ? JobState::backlogged
                                        : JobState::queued);
  job.scheduled_at.reset();
  record.overrun_at.reset();
  record.judged_at = 0;
  changed(record);
}

void Scheduler::brake(Record& record, AfterStop then) {
  if (record.job.state == JobState::scheduled && !record.dispatched) {
    withdraw(record, then);
    return;
  }
  // A cancel or a failure outlives a later stop; a stop never turns one into a mere hold.
  const bool first = !record.job.stopping;
  if (first || record.after_stop == AfterStop::hold) record.after_stop = then;
  if (first) {
    record.job.stopping = true;
    record.overrun_at.reset();
    ++version_;
    effects_.push_back(Brake{record.job.id});
  }
  if (then == AfterStop::hold && record.after_stop == AfterStop::hold && record.job.started_at) {
    set_state(record, JobState::holding);
  }
  changed(record);
}

void Scheduler::on(const Stop& input) {
  ++version_;  // an answer that is under way shall start nothing on these arms
  lanes_changed_ = true;
  for (ArmId arm : input.arms) {
    if (!stopped_[arm.index()]) stopped_[arm.index()] = input.cause;
    if (!order_[arm.index()].empty()) {
      Record& record = records_.at(order_[arm.index()].front());
      const bool undispatched = record.job.state == JobState::scheduled && !record.dispatched;
      if (undispatched) continue;  // keeps its place between the others
      if (holds_reservation(record) && !record.job.stopping) {
        brake(record, AfterStop::hold);
        set_waits(record, {Wait{.kind = Wait::Kind::stop, .arm = arm, .detail = input.cause}});
      }
    }
  }
}

void Scheduler::on(const Resume& input) {
  for (ArmId arm : input.arms) stopped_[arm.index()].reset();
  ++version_;
  lanes_changed_ = true;
}

void Scheduler::on(const SceneChanged&) {
  disturbed_at_ = ++version_;
  sequence_.forget_passages();
}

void Scheduler::on(const Interrupt&) {
  const std::vector<JobId> ids(active_.begin(), active_.end());
  for (JobId id : ids) records_.at(id).job.after.clear();  // none fails for another's sake
  for (JobId id : ids) {
    Record& record = records_.at(id);
    const bool moved = record.job.started_at.has_value();
    end(record, JobState::interrupted, Reason::server_restart,
        moved ? "the server ended while it was under way" : "the server ended before it began");
  }
}

void Scheduler::on(const Wake&) {}

void Scheduler::set_state(Record& record, JobState state) {
  const JobId id = record.job.id;
  const JobState before = std::exchange(record.job.state, state);
  follow_lanes(record.job, before);
  if (state == JobState::queued || is_terminal(state)) {
    past_queue_.erase(id);
  } else {
    past_queue_.insert(id);
  }
  unexplained_.insert(id);
}

void Scheduler::end(Record& record, JobState state, Reason reason, std::string detail) {
  Job& job = record.job;
  if (state != JobState::succeeded) leave_graph(record);
  if (state == JobState::succeeded) graph_.finish(job.id);
  set_state(record, state);
  job.stopping = false;
  job.ended_at = now_;
  job.reason = reason;
  job.detail = std::move(detail);
  if (reason != Reason::deadlock) job.ring.clear();
  if (state != JobState::expired) job.waits_on.clear();  // else: what it waited for in vain
  if (state == JobState::succeeded) job.progress = job.trajectory->duration();
  for (ArmId arm : job.trajectory->arms()) {
    auto& queue = order_[arm.index()];
    const auto next = queue.erase(std::ranges::find(queue, job.id));
    if (next != queue.end()) unexplained_.insert(*next);
    work_[arm.index()] -= job.trajectory->duration();
  }
  active_.erase(job.id);
  unexplained_.erase(job.id);
  if (--priorities_.at(job.priority) == 0) priorities_.erase(job.priority);
  ++version_;
  changed(record);
  forget_predecessor(job.id, state == JobState::succeeded);
}

// Nobody waits for a job that has ended: those that named it in `after` go on, or fail with it.
void Scheduler::forget_predecessor(JobId ended, bool succeeded) {
  const auto node = followers_.extract(ended);
  if (node.empty()) return;
  for (JobId id : node.mapped()) {
    if (!active_.contains(id)) continue;  // failed meanwhile, with another of its own
    Record& record = records_.at(id);
    if (std::erase(record.job.after, ended) == 0 || succeeded) continue;
    end(record, JobState::failed, Reason::predecessor_failed,
        "a job that it comes after did not succeed");
  }
}

void Scheduler::expire_and_overrun() {
  const std::vector<JobId> ids(past_queue_.begin(), past_queue_.end());
  for (JobId id : ids) {
    Record& record = records_.at(id);
    Job& job = record.job;
    see_whether_in_vain(record);
    const bool backlogged = job.state == JobState::backlogged;
    if (backlogged && now_ >= *job.backlogged_at + job.backlog_timeout) {
      end(record, JobState::expired, Reason::backlog_timeout,
          "waited " + seconds_text(job.backlog_timeout) + " in the backlog");
    } else if (record.in_vain_since && now_ >= *record.in_vain_since + job.backlog_timeout) {
      give_up(record);
    } else if (overruns(record)) {
      record.fail_reason = Reason::overrun;
      record.fail_detail = "has not moved for " + seconds_text(now_ - record.moved_at) +
                           ", and has had its duration by duration_scaling and duration_margin";
      brake(record, AfterStop::fail);
    }
  }
}

// On its path, where only a job of another arm that has none, or another scene, would let it go on.
void Scheduler::see_whether_in_vain(Record& record) const {
  const bool held = record.job.state == JobState::holding && waiting(record);
  if ((!held && !record.job.pausing) || record.job.stopping || stop_of(record)) {
    record.in_vain_since.reset();
    return;
  }
  if (held && record.judged_at != version_) return;  // not known yet
  const auto waits = found_in_the_way(record);
  const bool in_vain = std::ranges::any_of(waits, [this](const Wait& wait) {
    return wait.kind == Wait::Kind::object ||
           (wait.kind == Wait::Kind::arm && order_[wait.arm->index()].empty());
  });
  if (!in_vain) record.in_vain_since.reset();
  if (in_vain && !record.in_vain_since) record.in_vain_since = now_;
}

void Scheduler::give_up(Record& record) {
  record.in_vain_since.reset();
  record.fail_reason = Reason::backlog_timeout;
  record.fail_detail = "waited " + seconds_text(record.job.backlog_timeout) + " on its path";
  if (holds_reservation(record)) return brake(record, AfterStop::fail);
  end(record, JobState::expired, record.fail_reason, record.fail_detail);
  effects_.push_back(Release{record.job.id});
}

void Scheduler::ask_for_wake() {
  std::optional<TimePoint> next;
  const auto consider = [&next](TimePoint when) { next = next ? std::min(*next, when) : when; };
  for (JobId id : past_queue_) {
    const Record& record = records_.at(id);
    if (record.job.state == JobState::backlogged) {
      consider(*record.job.backlogged_at + record.job.backlog_timeout);
    }
    if (record.overrun_at && !record.job.stopping) consider(*record.overrun_at);
    if (record.in_vain_since) consider(*record.in_vain_since + record.job.backlog_timeout);
  }
  const bool undecided =
      std::ranges::any_of(rings_, [](const NamedRing& r) { return !r.way_out && !r.opens; });
  if (undecided) consider(now_ + Duration(1));  // a step of its own
  if (next && next != wake_at_) effects_.push_back(WakeAt{*next});
  wake_at_ = next;
}

}  // namespace armloom

#include "core/scheduler/scheduler.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace armloom {
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
  if (state == JobState::succeeded) {
    graph_.finish(job.id);
  } else {
    leave_graph(record);
  }
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

}  // namespace armloom

// How far each motion that is admitted may go: orders, held by authority over progress.
#include <algorithm>
#include <utility>

#include "core/scheduler/scheduler.h"
#include "core/scheduler/waits.h"

namespace armloom {
namespace {

// Authority is extended by no less than this, but for the last bit.
constexpr Duration kGrantStep = std::chrono::milliseconds(80);
// Nearer than this to its limit, a motion has come to it.
constexpr Duration kAtLimit = std::chrono::milliseconds(2);

}  // namespace

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

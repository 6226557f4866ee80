// What ends with time: the backlog, waits in vain, motions that stand still.
#include <algorithm>
#include <cstdio>

#include "core/scheduler/scheduler.h"

namespace armloom {
namespace {

std::string seconds_text(Duration duration) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g s", to_seconds(duration));
  return text;
}

}  // namespace

// Later than this, going on from `start_at`, it may overrun.
void Scheduler::expect_end(Record& record, TimePoint start_at) const {
  const double remaining_s = to_seconds(record.job.trajectory->duration() - record.job.progress);
  record.overrun_at = start_at + from_seconds(remaining_s * cell_->execution.duration_scaling) +
                      cell_->execution.duration_margin;
  record.moved_at = start_at;
}

// Its time has passed, and it stands still.
bool Scheduler::overruns(Record& record) const {
  if (!record.overrun_at || now_ < *record.overrun_at || record.job.stopping) return false;
  record.overrun_at = std::max(*record.overrun_at, record.moved_at + kStandstill);
  return now_ >= *record.overrun_at;
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
    Record& record = records_.at(id);
    see_whether_in_vain(record);  // as this step leaves it
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

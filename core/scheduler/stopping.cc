// How motions stop, and what becomes of their jobs where they come to rest.
#include <algorithm>
#include <utility>

#include "core/scheduler/scheduler.h"

namespace armloom {

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

}  // namespace armloom

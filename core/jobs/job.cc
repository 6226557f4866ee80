#include "core/jobs/job.h"

namespace armloom {

const char* to_string(JobState state) {
  switch (state) {
    case JobState::queued:
      return "queued";
    case JobState::backlogged:
      return "backlogged";
    case JobState::scheduled:
      return "scheduled";
    case JobState::running:
      return "running";
    case JobState::holding:
      return "holding";
    case JobState::succeeded:
      return "succeeded";
    case JobState::canceled:
      return "canceled";
    case JobState::expired:
      return "expired";
    case JobState::failed:
      return "failed";
    case JobState::interrupted:
      return "interrupted";
  }
  return "unknown";
}

const char* to_string(Wait::Kind kind) {
  switch (kind) {
    case Wait::Kind::job:
      return "job";
    case Wait::Kind::arm:
      return "arm";
    case Wait::Kind::object:
      return "object";
    case Wait::Kind::order:
      return "order";
    case Wait::Kind::capacity:
      return "capacity";
    case Wait::Kind::stop:
      return "stop";
    case Wait::Kind::plan:
      return "plan";
  }
  return "unknown";
}

const char* to_string(Reason reason) {
  switch (reason) {
    case Reason::completed:
      return "completed";
    case Reason::canceled_by_client:
      return "canceled_by_client";
    case Reason::backlog_timeout:
      return "backlog_timeout";
    case Reason::start_mismatch:
      return "start_mismatch";
    case Reason::self_collision:
      return "self_collision";
    case Reason::predecessor_failed:
      return "predecessor_failed";
    case Reason::arm_fault:
      return "arm_fault";
    case Reason::overrun:
      return "overrun";
    case Reason::server_restart:
      return "server_restart";
    case Reason::deadlock:
      return "deadlock";
    case Reason::no_plan:
      return "no_plan";
  }
  return "unknown";
}

const char* to_string(AnotherWay::Cause cause) {
  switch (cause) {
    case AnotherWay::Cause::client:
      return "client";
    case AnotherWay::Cause::timeout:
      return "timeout";
    case AnotherWay::Cause::blocked:
      return "blocked";
  }
  return "unknown";
}

void Job::note_start(TimePoint now) {
  if (!times.motion_started_at) times.motion_started_at = now;
  if (!times.started_at) times.started_at = now;
}

JobState Job::state() const {
  if (const auto* queued = in<Queued>()) {
    return queued->in_backlog ? JobState::backlogged : JobState::queued;
  }
  if (const auto* ended = in<Ended>()) return ended->state;
  if (in<Held>() != nullptr) return JobState::holding;
  if (const auto* braking = in<Braking>()) return braking->state;
  const auto* moving = in<Moving>();
  return moving != nullptr && moving->is_under_way ? JobState::running : JobState::scheduled;
}

bool Job::pausing() const {
  if (const auto* admitted = in<Admitted>()) return admitted->pause.has_value();
  if (const auto* moving = in<Moving>()) return moving->pause.has_value();
  const auto* braking = in<Braking>();
  return braking != nullptr && braking->paused;
}

const GoalWay* Job::stands_in() const {
  if (!is_unplanned()) return nullptr;
  const GoalWay* first = nullptr;
  for (std::size_t k = 0; k < goal->ways.size(); ++k) {
    const GoalWay& way = goal->ways[k];
    if (!has_open_arm() && k != goal->taken) continue;
    if (way.question || way.is_planned) return nullptr;
    if (way.stands_in && first == nullptr) first = &way;
  }
  return first;
}

std::optional<Reason> Job::reason() const {
  const auto* ended = in<Ended>();
  return ended != nullptr ? std::optional(ended->reason) : std::nullopt;
}

std::string Job::detail() const {
  const auto* ended = in<Ended>();
  return ended != nullptr ? ended->detail : std::string();
}

std::optional<TimePoint> Job::ended_at() const {
  const auto* ended = in<Ended>();
  return ended != nullptr ? std::optional(ended->at) : std::nullopt;
}

}  // namespace armloom

#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/base/enumeration.h"
#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/proximity.h"

namespace armloom {

// Enums that clients see of a job: its state, its waits, and the reason of its end.

// A job's published state; follows from the phase of its step (step.h).
enum class JobState {
  queued,      // not checked yet, or not its turn
  backlogged,  // checked and in conflict; `waits_on` names the other job, arm or object
  scheduled,   // admitted, starts at scheduled_at
  running,
  paused,  // on its path, at rest or braking
  succeeded,
  canceled,
  expired,
  failed,
  interrupted,
};
[[nodiscard]] constexpr bool is_terminal(JobState s) { return s >= JobState::succeeded; }
[[nodiscard]] constexpr const char* to_string(JobState state) {
  switch (state) {
    case JobState::queued:
      return "queued";
    case JobState::backlogged:
      return "backlogged";
    case JobState::scheduled:
      return "scheduled";
    case JobState::running:
      return "running";
    case JobState::paused:
      return "paused";
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
  return nullptr;
}
// The terminal states.
inline constexpr auto kJobEnds = std::span(kValues<JobState>).last<5>();
static_assert(is_terminal(kJobEnds.front()) && !is_terminal(*(kJobEnds.begin() - 1)));

// Why a job does not move.
struct Wait {
  enum class Kind {
    job,
    arm,
    object,
    predecessor,
    capacity,
    stop,
    plan,
    check,
    guard,
    speed,
    io,
    action,
    holding
  };
  Kind kind;
  std::optional<JobId> job;  // job, predecessor, capacity
  // arm, stop; holding: the arm that must move too, or that holds too much; speed: if it is the
  // arm's override; job: the other arm that comes too close
  std::optional<ArmId> arm;
  // job, arm, object: the pair of links that comes too close; predecessor: the same, if this job
  // would end in the path of that job
  std::optional<Proximity> proximity;
  Duration own_time{};    // with proximity: time in this job's trajectory
  Duration other_time{};  // and in the other trajectory
  // stop: its cause; speed, holding: the remedy; predecessor: why it goes first; io: what the
  // signal is
  std::string detail = {};
  std::string signal = {};        // io
  bool has_no_way_aside = false;  // arm: all retreats of that arm were tried

  bool operator==(const Wait&) const = default;
  // Returns true if both waits name the same cause; times and distances may differ. Used to publish
  // no event if only these have changed.
  [[nodiscard]] bool same_cause(const Wait& other) const {
    return kind == other.kind && job == other.job && arm == other.arm && detail == other.detail &&
           signal == other.signal && has_no_way_aside == other.has_no_way_aside;
  }
};
[[nodiscard]] constexpr const char* to_string(Wait::Kind kind) {
  switch (kind) {
    case Wait::Kind::job:
      return "job";
    case Wait::Kind::arm:
      return "arm";
    case Wait::Kind::object:
      return "object";
    case Wait::Kind::predecessor:
      return "predecessor";
    case Wait::Kind::capacity:
      return "capacity";
    case Wait::Kind::stop:
      return "stop";
    case Wait::Kind::plan:
      return "plan";
    case Wait::Kind::check:
      return "check";
    case Wait::Kind::guard:
      return "guard";
    case Wait::Kind::speed:
      return "speed";
    case Wait::Kind::io:
      return "io";
    case Wait::Kind::action:
      return "action";
    case Wait::Kind::holding:
      return "holding";
  }
  return nullptr;
}

// Closed list; core/scheduler/README.md explains each.
enum class Reason {
  completed,
  canceled_by_client,
  backlog_timeout,
  start_mismatch,      // the arm is not where the trajectory begins
  self_collision,      // the job's arms would hit themselves or each other: it can never run
  predecessor_failed,  // a job named in `after` ended without success
  arm_fault,
  overrun,  // has exceeded duration x duration_scaling + duration_margin, and does not move
  server_restart,
  deadlock,     // it was in a deadlock cycle and was submitted last
  step_failed,  // an action of the job could not be done, or waited too long
  no_plan,      // no path to the goal was found, or every plan was out of date when it arrived
};
[[nodiscard]] constexpr const char* to_string(Reason reason) {
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
    case Reason::step_failed:
      return "step_failed";
    case Reason::no_plan:
      return "no_plan";
  }
  return nullptr;
}

}  // namespace armloom

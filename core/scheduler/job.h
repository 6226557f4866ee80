#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/verdict.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

enum class JobState {
  queued,      // not judged yet: just arrived, or behind another job of its arm
  backlogged,  // judged, in conflict: `waits_on` says with what
  scheduled,   // admitted, starts at scheduled_at
  running,
  holding,  // in the middle of its path, at rest or braking, until resumed
  succeeded,
  canceled,
  expired,
  failed,
  interrupted,
};
[[nodiscard]] constexpr bool is_terminal(JobState s) { return s >= JobState::succeeded; }
[[nodiscard]] const char* to_string(JobState state);

// Why a job does not move.
struct Wait {
  enum class Kind { job, arm, object, order, capacity, stop };
  Kind kind;
  std::optional<JobId> job;            // job, order, capacity
  std::optional<ArmId> arm;            // arm, stop; job: the other's arm that comes too close
  std::optional<Proximity> proximity;  // job, arm, object: evidence
  Duration own_time{};                 // with proximity: trajectory time of this job
  Duration other_time{};               // and of the other one
  std::string detail = {};             // stop: its cause

  // Same obstacle, whatever the figures: used to spare clients a repeated event.
  [[nodiscard]] bool same_cause(const Wait& other) const {
    return kind == other.kind && job == other.job && arm == other.arm && detail == other.detail;
  }
};
[[nodiscard]] const char* to_string(Wait::Kind kind);

// Closed list; README.md beside this file explains each.
enum class Reason {
  completed,
  canceled_by_client,
  backlog_timeout,
  start_mismatch,      // the arm does not stand where the trajectory begins
  self_collision,      // the arm would hit itself: it can never run
  predecessor_failed,  // a job named in `after` ended without success
  arm_fault,
  overrun,  // took longer than execution.duration_scaling and _margin allow, and stands still
  server_restart,
  deadlock,  // it waited in a ring of jobs none of which could ever move, and came last
};
[[nodiscard]] const char* to_string(Reason reason);

// A job as the scheduler knows it. Read-only for everyone else.
struct Job {
  JobId id;
  TrajectoryPtr trajectory;
  int priority = 0;
  Duration backlog_timeout{};
  std::vector<JobId> after;  // those that have not ended yet
  bool own = false;          // the server's: a move aside
  JobState state = JobState::queued;
  bool stopping = false;  // braking: on the way to canceled, holding or failed
  TimePoint submitted_at{};
  std::optional<TimePoint> backlogged_at;  // the first time
  std::optional<TimePoint> scheduled_at;
  std::optional<TimePoint> started_at;
  std::optional<TimePoint> ended_at;
  Duration progress{};           // trajectory time, last measured
  TimePoint progress_seen_at{};  // when it was measured
  bool pausing = false;          // running, at rest on its way until others have passed
  std::vector<Wait> waits_on;
  // The deadlock that it is part of, this job first: each waits for the next one, the last for the
  // first. Empty: none. Kept by the job that ends for it.
  std::vector<JobId> ring;
  std::optional<Reason> reason;  // terminal
  std::string detail;            // terminal: one sentence; deadlock: empty, the ring says it
};

}  // namespace armloom

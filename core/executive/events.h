#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/guard_refusal.h"
#include "core/coordination/verdict.h"
#include "core/jobs/job.h"
#include "core/model/cell.h"
#include "core/monitor/monitor.h"

namespace armloom {

// What clients see of a job: the scheduler's Job with names instead of ids. Plain data, copied
// freely between threads. Times are cell time; the server adds wall time.
struct WaitView {
  Wait::Kind kind;
  std::string job;                 // key; empty: none
  std::string arm;                 // name; empty: none
  std::vector<std::string> links;  // own, other; or empty
  std::optional<double> own_time_s;
  std::optional<double> other_time_s;
  std::optional<double> clearance_m;
  std::string detail;
  std::optional<double> progress = {};  // check: 0 to 1
};

// That it was taken before others, or by one of several arms (scheduler/job.h, Choice).
struct ChoiceView {
  std::vector<std::string> candidates;  // keys of jobs, or names of arms
  std::string selected;                 // of these
  std::optional<double> time_saved_s;
  std::string detail;  // one sentence
};
// How a job ended.
struct JobResultView {
  Reason reason;
  std::string detail;
};

// The answer to "what if": the Verdict of the design.
struct CheckView {
  Verdict::Kind kind = Verdict::Kind::free;
  std::optional<double> earliest_start_s;        // from now; absent: not known
  std::optional<double> clearance_bound_m;       // ClearanceBound; absent: nothing is proven
  std::optional<double> self_clearance_bound_m;  // likewise
  std::vector<WaitView> waits_on;                // as the job's own; free: before it starts
  std::vector<WaitView> conflicts;               // not free: the same
  std::uint64_t evaluations = 0;
  std::uint64_t scene_version = 0;
  std::optional<ChoiceView> choice;       // of a goal that several arms could go to
  std::optional<double> move_to_start_s;  // from now until its arms are where it begins
  std::optional<JobResultView> result;    // it would end at once
};
// Other ways that were looked for, for a job (scheduler/ways/replanning.h).
struct AnotherWayView {
  std::uint64_t done = 0;                               // so many times it was given one
  bool is_open = false;                                 // one is being looked for
  AnotherWay::Cause cause = AnotherWay::Cause::client;  // of the last time
  std::optional<std::string> refusal;                   // why it kept its own, the last time
};
// Ways around the places that others hold (scheduler/ways/detour.h).
struct DetourView {
  std::uint64_t candidates_evaluated = 0;  // so many
  bool is_selected = false;                // it goes by one of them
  std::optional<double> time_saved_s;  // nothing: none is taken, or the shortest way could not go
};
// What was left open of a job, and how that came out.
struct JobWaysView {
  std::vector<std::string> alternatives;  // names of arms of which one does it
  std::optional<ChoiceView> choice;
  std::optional<DetourView> detour;
  std::optional<AnotherWayView> another_way;
};
struct JobTimesView {
  TimePoint submitted_at{};
  std::optional<TimePoint> backlogged_at;  // the first time
  std::optional<TimePoint> expires_at;     // while it waits in the backlog, or in vain on its path
  std::optional<TimePoint> scheduled_at;
  std::optional<TimePoint> started_at;
  std::optional<TimePoint> ended_at;
};
// Its trajectory, and how far it has come.
struct JobMotionView {
  Duration duration{};
  std::optional<bool> planned;  // of a goal: else the duration is an estimate
  double progress = 0.0;        // 0..1
  bool stopping = false;
};
struct JobView {
  JobId id{0};
  std::string key;   // the "id" that clients use
  std::string name;  // may be empty
  JobState state = JobState::queued;
  std::vector<std::string> arms;
  JobTerms terms = {};
  bool system_job = false;  // the server's own
  JobTimesView times = {};
  JobMotionView motion = {};
  JobWaysView ways = {};
  std::vector<WaitView> waits_on;
  std::vector<std::string> cycle;       // keys: the deadlock that it is part of, itself first
  std::optional<JobResultView> result;  // when ended

  [[nodiscard]] std::optional<Reason> reason() const {
    return result ? std::optional(result->reason) : std::nullopt;
  }
  [[nodiscard]] std::string detail() const { return result ? result->detail : ""; }
};

enum class ArmState { idle, moving, paused, stopped, fault };
[[nodiscard]] constexpr const char* to_string(ArmState state) {
  switch (state) {
    case ArmState::idle:
      return "idle";
    case ArmState::moving:
      return "moving";
    case ArmState::paused:
      return "paused";
    case ArmState::stopped:
      return "stopped";
    case ArmState::fault:
      return "fault";
  }
  return nullptr;
}

struct ArmView {
  std::string name;
  std::string robot;
  ArmState state = ArmState::idle;
  std::string job;  // key of the job in motion or paused; empty: none
  double progress = 0.0;
  std::vector<std::string> joints;
  std::vector<double> q;  // measured, as joints
  std::vector<double> home;
  double deviation_rad = 0.0;  // measured distance from its own path, largest joint
};

struct QueueView {
  std::string policy;
  bool stopped = false;                                          // every arm is stopped
  std::vector<std::string> queued, backlog, scheduled, running;  // keys
  bool operator==(const QueueView&) const = default;
};

// The objects of the planning scene; `version` grows with every change.
struct SceneView {
  std::uint64_t version = 0;
  std::vector<CollisionObject> objects;
};

struct MonitorEvent {
  MonitorFinding finding;
  std::vector<std::string> arms;     // of the pair
  std::vector<std::string> stopped;  // names of the arms that were told to stop
};
// The guard kept an arm from what the scheduler had granted: a defect, which moved no arm.
struct GuardEvent {
  GuardRefusal refusal;
  std::string arm;
  std::string job;        // key
  std::string other_arm;  // empty: the scene, or the arms of the same motion
  std::string other_job;  // that the other arm is on, or was last; empty: none
};
struct Alert {
  enum class Level { info, warning, error };
  Level level;
  std::string text;
};
[[nodiscard]] constexpr const char* to_string(Alert::Level level) {
  switch (level) {
    case Alert::Level::info:
      return "info";
    case Alert::Level::warning:
      return "warning";
    case Alert::Level::error:
      return "error";
  }
  return nullptr;
}

// One entry of the log. Job events are never dropped; seq has no holes.
struct Event {
  std::uint64_t seq;
  TimePoint time;
  std::variant<JobView, ArmView, QueueView, SceneView, MonitorEvent, GuardEvent, Alert> body;
};

// A motion that an arm has been told of. Trajectory time.
struct ArmAuthority {
  std::string arm;       // name
  std::string job;       // key
  Duration progress{};   // measured
  Duration authority{};  // it may go so far, unless more is granted
};

// Poses: may be dropped.
struct StateFrame {
  TimePoint time;
  Configuration q;                         // measured, all joints of the cell
  std::vector<Proximity> clearance;        // closest pair of two arms, and of an arm with the scene
  std::vector<ArmAuthority> motions = {};  // in the order of jobs
};

// Everything at one instant: what a new client gets first.
struct Snapshot {
  std::uint64_t seq = 0;  // of the last event that is contained
  TimePoint time;
  QueueView queue;
  SceneView scene;
  std::vector<ArmView> arms;
  std::vector<JobView> jobs;  // all not ended, then the latest ended, in order of submission
};

}  // namespace armloom

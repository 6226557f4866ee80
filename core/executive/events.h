#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/arm/arm_link.h"
#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/guard_refusal.h"
#include "core/coordination/verdict.h"
#include "core/jobs/job_terms.h"
#include "core/jobs/job_words.h"
#include "core/jobs/ways.h"
#include "core/model/cell.h"
#include "core/monitor/finding.h"

namespace armloom {

// Views of the scheduler's objects for clients, with names instead of ids. Plain data, copied
// freely between threads. Times are cell time; the server adds wall time.
struct WaitView {
  Wait::Kind kind;
  std::string job;  // io: the signal
  std::string arm;
  std::vector<std::string> links;  // own, other; or empty
  std::optional<double> own_time_s;
  std::optional<double> other_time_s;
  std::optional<double> clearance_m;
  std::string detail;
  std::optional<double> progress = {};  // check: 0 to 1
};

// See Choice in core/jobs/step.h.
struct ChoiceView {
  std::vector<std::string> candidates;
  std::string selected;  // one of `candidates`
  std::optional<double> time_saved_s;
  std::string detail;  // one sentence
};
// How a job ended.
struct JobResultView {
  Reason reason;
  std::string detail;
  std::optional<std::size_t> step = {};  // of a task: the index of the step at which it ended
};
enum class StepState { waiting, running, done, failed };
[[nodiscard]] constexpr const char* to_string(StepState state) {
  switch (state) {
    case StepState::waiting:
      return "waiting";
    case StepState::running:
      return "running";
    case StepState::done:
      return "done";
    case StepState::failed:
      return "failed";
  }
  return nullptr;
}
// A step of a task.
struct StepView {
  std::string name;  // may be empty
  std::string kind;  // kind_of()
  StepState state = StepState::waiting;
  std::string detail;             // what it does: "part to left_hand"
  std::vector<std::string> arms;  // of a motion
  double progress = 0.0;          // of a motion, 0 to 1
};

struct CheckView {
  Verdict::Kind kind = Verdict::Kind::free;
  std::optional<double> earliest_start_s;        // from now; nullopt: not known
  std::optional<double> clearance_bound_m;       // ClearanceBound; nullopt: not certified
  std::optional<double> self_clearance_bound_m;  // likewise
  std::vector<WaitView> waits_on;                // free: what it waits for until it starts
  std::vector<WaitView> conflicts;               // not free: what it waits for
  std::uint64_t evaluations = 0;
  std::uint64_t scene_version = 0;
  std::optional<ChoiceView> choice;       // for a goal with several candidate arms
  std::optional<double> move_to_start_s;  // time until the server has moved its arms to its start
  std::optional<JobResultView> result;    // set if the job would end at once
  std::optional<std::size_t> step;        // of a task: index of the first step that is not free
};
// See scheduler/ways/replanning.h.
struct AnotherWayView {
  std::uint64_t done = 0;  // successful replans
  bool is_open = false;
  AnotherWay::Cause cause = AnotherWay::Cause::client;
  std::optional<std::string> refusal;  // why the last replan failed
};
// See scheduler/ways/detour.h.
struct DetourView {
  std::uint64_t candidates_evaluated = 0;
  bool is_selected = false;
  // Nullopt if no detour was taken, or if the shortest path was not possible.
  std::optional<double> time_saved_s;
};
// See Starvation in core/jobs/step.h.
struct StarvationView {
  TimePoint waits_since;
  double bound_s = 0.0;  // scheduling.aging_s
  std::uint64_t overtaken_by = 0;
};
// The choices that a client left to the server, and the decisions.
struct JobWaysView {
  std::vector<std::string> alternatives;  // candidate arms, by name
  std::optional<ChoiceView> choice;
  std::optional<DetourView> detour;
  std::optional<AnotherWayView> another_way;
};
struct JobTimesView {
  TimePoint submitted_at{};
  std::optional<TimePoint> backlogged_at;  // the first time
  std::optional<TimePoint> expires_at;     // while backlogged or blocked on its path
  std::optional<TimePoint> scheduled_at;
  std::optional<TimePoint> started_at;
  std::optional<TimePoint> ended_at;
};
// A view of a step for clients.
struct JobMotionView {
  Duration duration{};
  std::optional<bool> planned;  // for a goal; if false, the duration is an estimate
  std::optional<bool> retimed;  // for a trajectory, true if the server computed its times
  std::optional<double> velocity_scaling;  // for a goal, in (0, 1]; `duration` includes it
  double progress = 0.0;                   // 0..1
  bool stopping = false;
  bool ends_at_rest = false;  // while it is stopping: it was canceled, or has failed
};
struct JobView {
  JobId id{0};
  std::string key;   // the "id" in the API
  std::string name;  // may be empty
  JobState state = JobState::queued;
  std::vector<std::string> arms;
  JobTerms terms = {};
  bool system_job = false;
  JobTimesView times = {};
  JobMotionView motion = {};
  JobWaysView ways = {};
  std::vector<StepView> steps;      // of a task
  std::optional<std::size_t> step;  // of a task: the index of the present step
  std::vector<WaitView> waits_on;
  std::optional<StarvationView> starvation;
  std::vector<std::string> cycle;       // keys of the deadlock cycle, this job first
  std::optional<JobResultView> result;  // when ended
  // Only in the answer to an amendment: why it changes nothing at present.
  std::optional<std::string> notice = {};

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
  std::string job;  // key of the job in motion or paused; empty if there is none
  double progress = 0.0;
  std::vector<std::string> joints;
  std::vector<double> q;  // measured, in the order of `joints`
  std::vector<double> home;
  // Measured distance from its path, of the joint with the largest distance (rad or m).
  double deviation_rad = 0.0;
  double deviation_max_rad = 0.0;                    // the largest since the session began
  ArmLink::State link = ArmLink::State::connecting;  // to its controller
  std::string link_detail;                           // why the link is not up; empty if it is
  bool drives_on = true;
  std::string stop_cause;  // why the arm is stopped; empty if it is not
  // Share of the planned speed, 0 to 1: of this arm; and at which it goes, with that of the cell.
  double speed_override = 1.0;
  double effective_speed_override = 1.0;
};

struct QueueView {
  std::string policy;
  bool stopped = false;                                          // every arm is stopped
  double speed_override = 1.0;                                   // of the cell
  std::vector<std::string> queued, backlog, scheduled, running;  // keys
  bool operator==(const QueueView&) const = default;
};

// An object that an arm holds. Its X_WO is the pose in the frame of the link.
struct HeldView {
  CollisionObject object;
  std::string link = {};
  std::string arm = {};
  std::vector<std::string> touch = {};  // Attachment::touch and touch_objects
  // Other hands that hold it too, with the object's pose in their frames.
  struct Other {
    std::string link = {};
    std::string arm = {};
    Eigen::Isometry3d X_LO = Eigen::Isometry3d::Identity();
  };
  std::vector<Other> shared_with = {};
};
// See AllowedTouch in core/model/attachment.h.
struct TouchView {
  std::string object;
  std::vector<std::string> links;
};
// The objects of the planning scene; `version` grows with every change.
struct SceneView {
  std::uint64_t version = 0;
  std::shared_ptr<const std::vector<CollisionObject>> shared = {};  // not null if published
  std::vector<HeldView> held = {};
  std::vector<TouchView> touch = {};
  // When objects expire, and which: both or none.
  std::optional<TimePoint> expires_at = {};
  std::shared_ptr<const std::vector<std::string>> expiring = {};
  std::vector<std::string> expired = {};  // with this version

  [[nodiscard]] const std::vector<CollisionObject>& objects() const { return *shared; }
};

// An input or output of the cell.
struct SignalView {
  std::string name;
  SignalDirection direction = SignalDirection::input;
  SignalType type = SignalType::boolean;
  std::string device = {};                    // empty if the signal is simulated
  std::optional<SignalValue> value = {};      // nullopt: not known
  std::optional<SignalValue> commanded = {};  // was sent to the device, which has not reported it
  bool is_connected = false;
  std::string detail = {};    // why it is not connected
  TimePoint changed_at = {};  // of the value
};

struct MonitorEvent {
  MonitorFinding finding;
  std::string text;                  // one sentence
  std::string joint;                 // name; empty if the finding has none
  std::vector<std::string> arms;     // of the pair, or the arm that violates a premise
  std::vector<std::string> stopped;  // names of the arms that were stopped
};
// The guard refused authority that the scheduler had granted. This is a defect of the scheduler,
// but no arm has moved.
struct GuardEvent {
  GuardRefusal refusal;
  std::string arm;
  std::string job;        // key
  std::string other_arm;  // empty if the refusal is about the scene or an arm of the same motion
  std::string other_job;  // present or last job of the other arm; may be empty
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

// One entry of the event log. Job events are never dropped; seq has no gaps.
struct Event {
  std::uint64_t seq;
  TimePoint time;
  std::variant<JobView, ArmView, QueueView, SceneView, SignalView, MonitorEvent, GuardEvent, Alert>
      body;
};

struct ArmAuthority {
  std::string arm;      // name
  std::string job;      // key
  Duration progress{};  // measured
  Duration authority{};
};

// A sample of the measured state; may be dropped.
struct StateFrame {
  TimePoint time;
  Configuration q;                   // measured, all joints of the cell
  std::vector<Proximity> clearance;  // the closest pairs of two arms, and of an arm and the scene
  std::vector<ArmAuthority> motions = {};  // in the order of jobs
};

// The complete status at one instant, sent first to a new subscriber.
struct Snapshot {
  std::uint64_t seq = 0;  // of the last event that it includes
  TimePoint time;
  QueueView queue;
  SceneView scene;
  std::vector<ArmView> arms;
  std::vector<SignalView> signals;
  std::vector<JobView> jobs;  // all not ended, then the latest ended, in order of submission
};

}  // namespace armloom

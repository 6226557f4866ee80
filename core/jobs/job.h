#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/plan_question.h"
#include "core/coordination/verdict.h"
#include "core/jobs/job_terms.h"
#include "core/jobs/job_words.h"
#include "core/jobs/path_request.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// The result of a waiting job's last check: what the job waits for.
struct Judgement {
  Version at = 0;  // zero: not checked yet
  std::vector<Wait> found = {};
  // The result is void once that step no longer precedes this job in the safe sequence.
  std::optional<StepId> in_turn_after = {};
};
// A rest on the path: after a stop, or until other motions have passed.
struct Pause {
  // Since when (motion clock) it waits for an object or an arm that no job moves.
  std::optional<TimePoint> in_vain_since = {};
};
// The next step of a job when its braking arms have come to rest.
struct AfterStop {
  enum class Then { hold, cancel, fail };
  Then then = Then::hold;
  Reason reason = Reason::overrun;  // fail
  std::string detail = {};          // fail
};

// The phases of a job, each with its own data, and their transitions (phases.h):
//
//   Queued    -> Admitted   with passing orders
//   Admitted  -> Moving     dispatched to its arms; or back to Queued, Held: withdrawn
//   Moving    -> Braking    canceled, stopped, overdue
//   Braking   -> Held       stopped on its path; Admitted, Queued: stopped before it moved
//   Held      -> Admitted   found free by a check; or back to Queued, with a new path
//   any       -> Ended
struct Queued {
  bool in_backlog = false;  // was in conflict when it was checked
  Judgement judgement = {};
};
struct Admitted {
  std::optional<Pause> pause = {};  // if it was stopped on its path
};
struct Moving {
  // Earliest time of an overrun; later if the motion still moves (deadlines.h).
  TimePoint overrun_at;
  TimePoint moved_at;  // the last time
  // Time and progress since which the motion has neither rested nor been near the limit of its
  // authority. Its pace is measured from here.
  TimePoint goes_since = {};
  Duration goes_from = {};
  bool is_under_way = false;  // has been measured to move; until then it is `scheduled`
  // Since it came to rest, motions were compared again (without_orders.h).
  bool was_compared = false;
  std::optional<Pause> pause = {};
};
struct Braking {
  AfterStop after;
  JobState state;                         // scheduled, running, paused
  bool paused = false;                    // was already at rest
  std::optional<Duration> rests_at = {};  // MotionReport::rests_at
};
struct Held {
  Judgement judgement = {};
  Pause pause = {};
};
struct Ended {
  JobState state;  // a terminal state
  Reason reason;
  std::string detail = {};  // one sentence; empty for a deadlock, whose jobs are in Job::ring
  TimePoint at = {};
};
using JobPhase = std::variant<Queued, Admitted, Moving, Braking, Held, Ended>;

struct JobTimes {
  TimePoint submitted_at{};
  std::optional<TimePoint> backlogged_at;  // the first time
  TimePoint backlog_clock{};               // the motion clock (SpeedOverride) then
  std::optional<TimePoint> scheduled_at;
  std::optional<TimePoint> started_at;         // it has moved, ...
  std::optional<TimePoint> motion_started_at;  // ... on its present path
  TimePoint measured_at{};                     // time of the last progress
};

// A choice that was made: this job among several jobs, or its arm among several arms; and what the
// choice gains.
struct Choice {
  // The candidates, as jobs or as arms; the other list is empty. The first candidate is the
  // default.
  std::vector<JobId> jobs = {};  // candidate jobs, this job included
  std::vector<ArmId> arms = {};  // candidate arms
  // An arm that could not do the job at all, and why.
  struct Without {
    ArmId arm;
    std::string why;
  };
  std::vector<Without> without = {};
  // How much the choice reduces the plan's cost (for a goal: the arrival time) compared with the
  // default; nullopt if the default was not possible.
  std::optional<Duration> saves = {};
};

// A goal for one arm, and the plan for it (goals.h).
struct GoalWay {
  MotionGoal goal;
  PathRequest request = {};                 // its tries: since the last plan that was up to date
  bool is_planned = false;                  // the job's trajectory is the plan, not an estimate
  std::optional<std::string> refusal = {};  // the planner's reason, if there is no plan
  std::optional<Proximity> stands_in = {};  // ... because the arm is too close to this object
  bool goes_through = false;                // the plan crosses positions of other arms (PlanMade)
};
// Detours of a goal's path around positions that other arms occupy (detour.h).
struct Detour {
  PathRequest request = {};
  bool is_weighed = false;       // the job temporarily has a candidate path, and is checked with it
  TrajectoryPtr best = nullptr;  // the best path so far (a candidate, or the job's own), ...
  TimePoint arrives{};           // ... and its predicted arrival
  bool is_taken = false;         // the selected path is a detour
  Duration saves{};              // time saved; zero if the shortest path was not possible
  TimePoint soon_enough{};       // a candidate that arrives by then is taken at once
};
struct JobGoal {
  // One for each of Job::alternatives until the arm is decided; else one.
  std::vector<GoalWay> ways;
  std::size_t taken = 0;    // index of the entry that belongs to Job::trajectory
  bool is_planned = false;  // all remaining entries are answered, and the one at `taken` has a plan
  std::optional<Detour> detour = {};

  [[nodiscard]] const GoalWay& way() const { return ways[taken]; }
  [[nodiscard]] GoalWay& way() { return ways[taken]; }
};

// Jobs submitted after this job were admitted although it had waited for scheduling.aging.
struct Starvation {
  TimePoint waits_since;     // the job could have gone first in its arms since then
  std::size_t overtaken_by;  // number of these jobs
};

// Replanning of a job (replanning.h).
struct AnotherWay {
  enum class Cause {
    client,   // requested by a client
    timeout,  // after the backlog timeout
    blocked,  // the job is blocked by an arm that no job moves, or is in a deadlock cycle
  };
  Cause cause = Cause::client;
  bool is_open = false;                     // requested and not answered
  PathRequest request = {};                 // its tries: since the last request by a client
  std::uint64_t done = 0;                   // number of successful replans
  std::optional<std::string> refusal = {};  // why the last one failed
};
[[nodiscard]] constexpr const char* to_string(AnotherWay::Cause cause) {
  switch (cause) {
    case AnotherWay::Cause::client:
      return "client";
    case AnotherWay::Cause::timeout:
      return "timeout";
    case AnotherWay::Cause::blocked:
      return "blocked";
  }
  return nullptr;
}

// Returns the only step of the job.
[[nodiscard]] constexpr StepId only_step(JobId job) { return StepId{job, 0}; }

struct Job {
  JobId id;
  TrajectoryPtr trajectory;
  JobTerms terms = {};
  std::vector<JobId> after = {};  // jobs of Submit::after that have not ended yet
  bool system_job = false;        // as in Submit
  bool is_held_over = false;
  bool awaits_record = false;  // StartRecorded
  // As in Submit. `trajectory` is one of them, and may change to another until admission. Empty
  // once the arm is decided.
  std::vector<TrajectoryPtr> alternatives = {};
  JobPhase phase = Queued{};
  JobTimes times = {};
  Duration progress{};  // trajectory time, last measured
  std::vector<Wait> waits_on = {};
  // The deadlock cycle that contains the job, this job first; empty if there is none. Each job
  // waits for the next one, and the last for the first. Not cleared if the job fails because of it.
  std::vector<JobId> ring = {};
  // Rare members are last because every step reads the members above.
  std::optional<Starvation> starvation = {};  // until the job is admitted
  std::optional<Choice> choice = {};
  std::optional<AnotherWay> another_way = {};
  std::optional<JobGoal> goal = {};

  [[nodiscard]] StepId step() const { return only_step(id); }
  template <typename P>
  [[nodiscard]] const P* in() const {
    return std::get_if<P>(&phase);
  }
  [[nodiscard]] JobState state() const;
  // True if the path must be planned (again) before the job can be checked.
  [[nodiscard]] bool is_unplanned() const { return goal && !goal->is_planned; }
  // Returns the job's goal that cannot be planned because an object is too close to its arm; with
  // several candidate arms, the first such goal. Null if there is none.
  [[nodiscard]] const GoalWay* stands_in() const;
  // True if the job's end is known: its path is planned, or its goal is a joint goal of one arm.
  [[nodiscard]] bool knows_its_end() const {
    if (!is_unplanned()) return true;
    return !has_open_arm() && std::holds_alternative<Eigen::VectorXd>(goal->way().goal.to);
  }
  // True if the job has a path and a detour is being planned.
  [[nodiscard]] bool is_detour_asked() const {
    return goal && goal->detour && goal->detour->request.question;
  }
  // True if the job has a goal and the choice among its candidate arms is still open.
  [[nodiscard]] bool has_open_arm() const { return goal && !alternatives.empty(); }
  // True if the job could take this alternative. For goals, its path must be planned.
  [[nodiscard]] bool may_go_by(std::size_t alternative) const {
    return !goal || goal->ways[alternative].is_planned;
  }
  // True while a replan is open; the job then stays at rest.
  [[nodiscard]] bool is_replanned_now() const { return another_way && another_way->is_open; }
  [[nodiscard]] bool has_ended() const { return in<Ended>() != nullptr; }
  // True if the job has moved on its present path.
  [[nodiscard]] bool has_started() const { return times.motion_started_at.has_value(); }
  void note_start(TimePoint now);
  // True if the job is braking. At rest it will be canceled, failed or paused.
  [[nodiscard]] bool stopping() const { return in<Braking>() != nullptr; }
  // True if the job rests on its path until others have passed.
  [[nodiscard]] bool pausing() const;
  // True if the job must be checked (again) before it moves.
  [[nodiscard]] bool is_waiting() const { return in<Queued>() != nullptr || in<Held>() != nullptr; }
  // True if it has passing orders.
  [[nodiscard]] bool is_admitted() const {
    return in<Admitted>() != nullptr || in<Moving>() != nullptr;
  }
  // True if it is admitted, or still braking.
  [[nodiscard]] bool has_authority() const { return is_admitted() || in<Braking>() != nullptr; }
  // Precondition: the job is waiting.
  [[nodiscard]] const Judgement& judgement() const {
    const auto* held = in<Held>();
    return held != nullptr ? held->judgement : std::get<Queued>(phase).judgement;
  }

  // For a job that has ended.
  [[nodiscard]] std::optional<Reason> reason() const;
  [[nodiscard]] std::string detail() const;
  [[nodiscard]] std::optional<TimePoint> ended_at() const;
};

}  // namespace armloom

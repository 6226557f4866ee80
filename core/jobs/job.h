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
#include "core/trajectory/trajectory.h"

namespace armloom {

// The waits of a waiting job, from its last check.
struct Judgement {
  Version at = 0;  // zero: not checked yet
  std::vector<Wait> found = {};
  std::optional<JobId> in_turn_after = {};  // applies while that job is ahead in the sequence
};
// A pause on the path until other motions have passed.
struct Pause {
  std::optional<TimePoint> in_vain_since = {};  // waits for something that no job moves
};
// How a job continues when its braking arms have come to rest.
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
  TimePoint overrun_at;  // unless it moves before
  TimePoint moved_at;    // the last time
  // Start (time, progress) of the present stretch without a rest or being near its limit.
  TimePoint goes_since = {};
  Duration goes_from = {};
  bool is_under_way = false;  // has been measured to move; until then it is `scheduled`
  bool was_compared = false;  // compared again since it came to rest (without_orders.h)
  std::optional<Pause> pause = {};
};
struct Braking {
  AfterStop after;
  JobState state;       // scheduled, running, paused
  bool paused = false;  // was already at rest
};
struct Held {
  Judgement judgement = {};
  Pause pause = {};
};
struct Ended {
  JobState state;  // a terminal state
  Reason reason;
  std::string detail = {};  // one sentence; empty for deadlock, because Job::ring has the jobs
  TimePoint at = {};
};
using JobPhase = std::variant<Queued, Admitted, Moving, Braking, Held, Ended>;

struct JobTimes {
  TimePoint submitted_at{};
  std::optional<TimePoint> backlogged_at;  // the first time
  std::optional<TimePoint> scheduled_at;
  std::optional<TimePoint> started_at;         // it has moved, ...
  std::optional<TimePoint> motion_started_at;  // ... on its present path
  TimePoint measured_at{};                     // time of the last progress
};

// The choice of this job among several jobs, or of its arm among several arms, and the gain.
struct Choice {
  // One of the two is empty. The first entry is the default.
  std::vector<JobId> jobs = {};  // candidate jobs, this job included
  std::vector<ArmId> arms = {};  // candidate arms
  // Arms that could not do the job at all, with the reason.
  struct Without {
    ArmId arm;
    std::string why;
  };
  std::vector<Without> without = {};
  // Reduction of the plan's cost compared with the default, or of the arrival time for a goal;
  // nullopt if the default was not possible.
  std::optional<Duration> saves = {};
};

// A goal for one arm, and the plan for it (goals.h).
struct GoalWay {
  MotionGoal goal;
  bool is_planned = false;                     // the job's trajectory is the plan, not an estimate
  std::optional<std::uint64_t> question = {};  // number of the open question
  int tries = 0;                               // since the last plan that was up to date
  Configuration beside = {};                   // positions of all arms in the last question, ...
  Version asked_at = 0;                        // ... and its version
  std::optional<std::string> refusal = {};     // the planner's reason, if there is no plan
  std::optional<Proximity> stands_in = {};     // ... because the arm is too close to this object
  bool goes_through = false;                   // passes positions of other arms (PlanMade)
};
// Detours of a goal's path around positions that other arms occupy (detour.h).
struct Detour {
  std::optional<std::uint64_t> question = {};  // number of the open question
  Configuration beside = {};                   // positions of all arms in the last question, ...
  Version asked_at = 0;                        // ... and its version
  int tries = 0;
  bool is_weighed = false;       // the job temporarily has another path, to be checked with it
  TrajectoryPtr best = nullptr;  // the best candidate so far, including the job's own path, ...
  TimePoint arrives{};           // ... and its predicted arrival
  bool is_taken = false;         // the selected path is a detour
  Duration saves{};              // time saved; zero if the shortest path was not possible
  TimePoint soon_enough{};       // a candidate that arrives by then is taken at once
};
struct JobGoal {
  std::vector<GoalWay> ways;  // several: parallel to Job::alternatives, until the job is admitted
  std::size_t taken = 0;      // index of the entry that belongs to Job::trajectory
  bool is_planned = false;    // all remaining entries are answered, and that of `taken` is planned
  std::optional<Detour> detour = {};

  [[nodiscard]] const GoalWay& way() const { return ways[taken]; }
  [[nodiscard]] GoalWay& way() { return ways[taken]; }
};

// Replanning of a job (replanning.h).
struct AnotherWay {
  enum class Cause {
    client,   // requested by a client
    timeout,  // after the backlog timeout
    blocked,  // by an arm that no job moves, or in a deadlock cycle
  };
  Cause cause = Cause::client;
  bool is_open = false;                        // requested and not answered
  std::optional<std::uint64_t> question = {};  // number of the last question
  Configuration beside = {};                   // positions of all arms in the last question, ...
  Version asked_at = 0;                        // ... and its version
  int tries = 0;                               // questions since the last request by a client
  std::uint64_t done = 0;                      // number of successful replans
  std::optional<std::string> refusal = {};     // why the last one failed
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

struct Job {
  JobId id;
  TrajectoryPtr trajectory;
  JobTerms terms = {};
  std::vector<JobId> after = {};  // jobs of Submit::after that have not ended yet
  bool system_job = false;        // as in Submit
  bool is_held_over = false;
  // `trajectory` is one of them, and may change until admission.
  std::vector<TrajectoryPtr> alternatives = {};
  JobPhase phase = Queued{};
  JobTimes times = {};
  Duration progress{};  // trajectory time, last measured
  std::vector<Wait> waits_on = {};
  // The deadlock cycle that contains the job, this job first: each waits for the next one, the last
  // for the first. Empty if there is none. Kept by a job that fails for it.
  std::vector<JobId> ring = {};
  // Rare members are last because every step reads the members above.
  std::optional<Choice> choice = {};
  std::optional<AnotherWay> another_way = {};
  std::optional<JobGoal> goal = {};

  template <typename P>
  [[nodiscard]] const P* in() const {
    return std::get_if<P>(&phase);
  }
  [[nodiscard]] JobState state() const;
  // True if the path must be planned (again) before the job can be checked.
  [[nodiscard]] bool is_unplanned() const { return goal && !goal->is_planned; }
  // Returns the goal (of several arms the first) that cannot be planned because of an object near
  // its arm; null if there is none.
  [[nodiscard]] const GoalWay* stands_in() const;
  // True if the job's end is known: planned, or a joint goal of one arm.
  [[nodiscard]] bool knows_its_end() const {
    if (!is_unplanned()) return true;
    return !has_open_arm() && std::holds_alternative<Eigen::VectorXd>(goal->way().goal.to);
  }
  // True if the job has a path and a detour is being planned.
  [[nodiscard]] bool is_detour_asked() const {
    return goal && goal->detour && goal->detour->question;
  }
  // True if the job has a goal and several candidate arms, not decided yet.
  [[nodiscard]] bool has_open_arm() const { return goal && !alternatives.empty(); }
  // True if the alternative is possible (goals: planned).
  [[nodiscard]] bool may_go_by(std::size_t alternative) const {
    return !goal || goal->ways[alternative].is_planned;
  }
  // True while a replan is open; the job then stays at rest.
  [[nodiscard]] bool is_replanned_now() const { return another_way && another_way->is_open; }
  [[nodiscard]] bool has_ended() const { return in<Ended>() != nullptr; }
  // On its present path.
  [[nodiscard]] bool has_started() const { return times.motion_started_at.has_value(); }
  void note_start(TimePoint now);
  // True if braking: it will be canceled, paused or failed.
  [[nodiscard]] bool stopping() const { return in<Braking>() != nullptr; }
  // True if at rest on its path until others have passed.
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

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

// What a job that waits was found to wait for, when it was judged last.
struct Judgement {
  Version at = 0;  // zero: not yet
  std::vector<Wait> found = {};
  std::optional<JobId> in_turn_after = {};  // while that one goes before it in the sequence
};
// At rest on its way until others have passed.
struct Pause {
  std::optional<TimePoint> in_vain_since = {};  // for what no job moves
};
// What becomes of a job when the arms that brake for it have come to rest.
struct AfterStop {
  enum class Then { hold, cancel, fail };
  Then then = Then::hold;
  Reason reason = Reason::overrun;  // fail
  std::string detail = {};          // fail
};

// The phases of a job, each with what it owns. What leads from one to the next (phases.h):
//
//   Queued    -> Admitted   with passing orders
//   Admitted  -> Moving     its arms are told; or back to Queued, Held: it is admitted no more
//   Moving    -> Braking    canceled, stopped, overdue
//   Braking   -> Held       stopped on its way; Admitted, Queued: stopped before it moved
//   Held      -> Admitted   resumed; its orders stand; or back to Queued, with another way
//   any       -> Ended
struct Queued {
  bool in_backlog = false;  // was in conflict when it was judged
  Judgement judgement = {};
};
struct Admitted {
  std::optional<Pause> pause = {};  // it was stopped on its way
};
struct Moving {
  TimePoint overrun_at;  // if it does not move before
  TimePoint moved_at;    // last
  // Since when, and from where, it has gone on without a stand and without coming near its limit.
  TimePoint goes_since = {};
  Duration goes_from = {};
  bool is_under_way = false;  // it has been seen to move; until then it is `scheduled`
  bool was_compared = false;  // with the others, since it stands (without_orders.h)
  std::optional<Pause> pause = {};
};
struct Braking {
  AfterStop after;
  JobState state;       // scheduled, running, paused
  bool paused = false;  // it stood already
};
struct Held {
  Judgement judgement = {};
  Pause pause = {};
};
struct Ended {
  JobState state;  // a terminal one
  Reason reason;
  std::string detail = {};  // one sentence; deadlock: empty, the ring says it
  TimePoint at = {};
};
using JobPhase = std::variant<Queued, Admitted, Moving, Braking, Held, Ended>;

struct JobTimes {
  TimePoint submitted_at{};
  std::optional<TimePoint> backlogged_at;  // the first time
  std::optional<TimePoint> scheduled_at;
  std::optional<TimePoint> started_at;         // it has moved, ...
  std::optional<TimePoint> motion_started_at;  // ... by the way that it has now
  TimePoint measured_at{};                     // when its progress was
};

// That a job was taken among several, or on one of several arms, and what for.
struct Choice {
  // Either is empty. What comes first is how things were.
  std::vector<JobId> jobs = {};  // that could have gone, it among them
  std::vector<ArmId> arms = {};  // on which it could have gone
  // By which it could not have gone at all, and why.
  struct Without {
    ArmId arm;
    std::string why;
  };
  std::vector<Without> without = {};
  // By so much the plan's cost is less than with what came first, or of a goal its arrival sooner;
  // nothing: that could not go.
  std::optional<Duration> saves = {};
};

// Where a job is to go by one arm, of which the way is still to be planned, or has been (goals.h).
struct GoalWay {
  MotionGoal goal;
  bool is_planned = false;                     // its trajectory is the plan; else an estimate
  std::optional<std::uint64_t> question = {};  // that is open: its number
  int tries = 0;                               // since a plan last fitted
  Configuration beside = {};                   // the last question: where all would stand, ...
  Version asked_at = 0;                        // ... and when it was asked
  std::optional<std::string> refusal = {};     // the answer to it, where there is no plan
  std::optional<Proximity> stands_in = {};     // ... as the arm stands too close to this
  bool goes_through = false;                   // where others stand (PlanMade)
};
// Another way to a goal, around the places that others hold (detour.h).
struct Detour {
  std::optional<std::uint64_t> question = {};  // that is open: its number
  Configuration beside = {};                   // the last question: where all would stand, ...
  Version asked_at = 0;                        // ... and when it was asked
  int tries = 0;
  bool is_weighed = false;       // the job has another way for a while, to be judged by it
  TrajectoryPtr best = nullptr;  // of the ways that were weighed, its own among them, ...
  TimePoint arrives{};           // ... and when it arrives by that, as it was predicted
  bool is_taken = false;         // that is another one than the shortest
  Duration saves{};              // so much sooner; zero: the shortest could not go as things stood
  TimePoint soon_enough{};       // what arrives by then is taken
};
struct JobGoal {
  std::vector<GoalWay> ways;  // several: of one arm each, as Job::alternatives until it is admitted
  std::size_t taken = 0;      // of these, that of Job::trajectory
  bool is_planned = false;    // all that still count are answered, and that one is planned
  std::optional<Detour> detour = {};

  [[nodiscard]] const GoalWay& way() const { return ways[taken]; }
  [[nodiscard]] GoalWay& way() { return ways[taken]; }
};

// Another way for a job, in place of the one that it had (replanning.h).
struct AnotherWay {
  enum class Cause {
    client,   // asked for it
    timeout,  // it had waited too long
    blocked,  // for an arm that no job moves, or in a ring
  };
  Cause cause = Cause::client;
  bool is_open = false;                        // asked for, and not answered
  std::optional<std::uint64_t> question = {};  // that was asked: its number
  Configuration beside = {};                   // the last question: where all would stand, ...
  Version asked_at = 0;                        // ... and when it was asked
  int tries = 0;                               // that were asked about, since a client did
  std::uint64_t done = 0;                      // so many times it was given another way
  std::optional<std::string> refusal = {};     // why not, the last time
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

// A job as the scheduler knows it. Read-only for everyone else.
struct Job {
  JobId id;
  TrajectoryPtr trajectory;
  JobTerms terms = {};
  std::vector<JobId> after = {};  // of Submit::after, those that have not ended yet
  bool system_job = false;        // as in Submit
  bool is_held_over = false;
  // `trajectory` is one of them: until it is admitted it is as good as chosen, but may be another.
  std::vector<TrajectoryPtr> alternatives = {};
  JobPhase phase = Queued{};
  JobTimes times = {};
  Duration progress{};  // trajectory time, last measured
  std::vector<Wait> waits_on = {};
  // The deadlock that it is part of, this job first: each waits for the next one, the last for the
  // first. Empty: none. Kept by the job that ends for it.
  std::vector<JobId> ring = {};
  // What few jobs have comes last: every step reads what stands above.
  std::optional<Choice> choice = {};
  std::optional<AnotherWay> another_way = {};
  std::optional<JobGoal> goal = {};

  template <typename P>
  [[nodiscard]] const P* in() const {
    return std::get_if<P>(&phase);
  }
  [[nodiscard]] JobState state() const;
  // Its way has to be planned (again) before it can be judged.
  [[nodiscard]] bool is_unplanned() const { return goal && !goal->is_planned; }
  // Nobody can say yet how it gets there, as its arm stands too close to something that no job
  // moves: it waits for that as a trajectory would. Of several arms that of the first; null: none.
  [[nodiscard]] const GoalWay* stands_in() const;
  // Where it leads is known, though perhaps not by which way: joints that one arm is to have.
  [[nodiscard]] bool knows_its_end() const {
    if (!is_unplanned()) return true;
    return !has_open_arm() && std::holds_alternative<Eigen::VectorXd>(goal->way().goal.to);
  }
  // It has a way, and another one is being looked for that may be sooner.
  [[nodiscard]] bool is_detour_asked() const {
    return goal && goal->detour && goal->detour->question;
  }
  // A goal that one of several arms will go to; which one is not decided.
  [[nodiscard]] bool has_open_arm() const { return goal && !alternatives.empty(); }
  // Whether there is such a way: of goals one that is planned.
  [[nodiscard]] bool may_go_by(std::size_t alternative) const {
    return !goal || goal->ways[alternative].is_planned;
  }
  // It stays where it is until it is known whether there is another way.
  [[nodiscard]] bool is_replanned_now() const { return another_way && another_way->is_open; }
  [[nodiscard]] bool has_ended() const { return in<Ended>() != nullptr; }
  // By the way that it has now.
  [[nodiscard]] bool has_started() const { return times.motion_started_at.has_value(); }
  void note_start(TimePoint now);
  // Braking: on the way to canceled, paused or failed.
  [[nodiscard]] bool stopping() const { return in<Braking>() != nullptr; }
  // At rest on its way until others have passed.
  [[nodiscard]] bool pausing() const;
  // It will not move before it is judged (again).
  [[nodiscard]] bool is_waiting() const { return in<Queued>() != nullptr || in<Held>() != nullptr; }
  // With passing orders, on its way to its end.
  [[nodiscard]] bool is_admitted() const {
    return in<Admitted>() != nullptr || in<Moving>() != nullptr;
  }
  // Judged free, and not at rest for good yet.
  [[nodiscard]] bool has_authority() const { return is_admitted() || in<Braking>() != nullptr; }
  // Precondition: it waits.
  [[nodiscard]] const Judgement& judgement() const {
    const auto* held = in<Held>();
    return held != nullptr ? held->judgement : std::get<Queued>(phase).judgement;
  }

  // Of one that has ended.
  [[nodiscard]] std::optional<Reason> reason() const;
  [[nodiscard]] std::string detail() const;
  [[nodiscard]] std::optional<TimePoint> ended_at() const;
};

}  // namespace armloom

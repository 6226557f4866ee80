#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/verdict.h"
#include "core/jobs/job.h"
#include "core/jobs/job_words.h"
#include "core/jobs/plan_requests.h"
#include "core/jobs/ways.h"
#include "core/sequence/safe_sequence.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// The result of a waiting job's last check: what the job waits for.
struct Judgement {
  Version at = 0;  // zero: not checked yet
  std::vector<Wait> found = {};
  // The result is void once that step no longer precedes this job in the safe sequence, or once the
  // sequence has got a leg that may let this job go first.
  struct InTurn {
    StepId after;
    JobId newest;  // Lanes::newest() then
  };
  std::optional<InTurn> in_turn = {};
};
// A rest on the path: after a stop, or until other motions have passed.
struct Pause {
  // Since when (motion clock) it waits for an object or an arm that no job moves.
  std::optional<TimePoint> in_vain_since = {};
};
// Tells what happens to a step when its braking arms have come to rest.
struct AfterStop {
  enum class Then {
    hold,
    decide_again,  // as `hold`, but its orders are dropped; `arm` and `detail` say why
    cancel,
    fail,
  };
  Then then = Then::hold;
  Reason reason = Reason::overrun;  // fail
  std::string detail = {};          // fail, decide_again
  std::optional<ArmId> arm = {};    // decide_again

  [[nodiscard]] bool ends() const { return then == Then::cancel || then == Then::fail; }
};

// The phases of a step, each with its own data, and their transitions (transitions.h):
//
//   Queued    -> Admitted   with passing orders
//   Admitted  -> Moving     dispatched to its arms; or back to Queued, Held: withdrawn
//   Moving    -> Braking    canceled, stopped, overdue; Held, Admitted: rests unasked
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
  // Since it came to rest, motions were compared again (weighing.h).
  bool was_compared = false;
  std::optional<Pause> pause = {};
};
struct Braking {
  AfterStop after;
  JobState state;                         // scheduled, running, paused
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
using StepPhase = std::variant<Queued, Admitted, Moving, Braking, Held, Ended>;

struct StepTimes {
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

// Jobs submitted after this job were admitted although it had waited for scheduling.aging.
struct Starvation {
  TimePoint waits_since;     // the job could have gone first in its arms since then
  std::size_t overtaken_by;  // number of these jobs
};

// Retreats of one arm tried for a job (yield_moves.h).
struct YieldsTried {
  struct Planned {
    bool is_answered = false;
    TrajectoryPtr way = nullptr;  // null if no path was found
  };
  std::size_t total = 0;  // number of tries for this job and for the server's jobs that help it
  std::size_t next = 0;   // index of the next candidate path from where `from` brought the arm
  TrajectoryPtr from;     // the motion that had brought the arm to its rest
  Planned planned = {};   // the planned retreat from there, tried last (yielding/yield_moves.h)
  // Ends of retreats made for this job and for the server's jobs that help it.
  std::vector<Eigen::VectorXd> went_to;
};

// Questions about a job.
struct Asking {
  // For admitted jobs: the version of the last check that found the motion free, and whether the
  // motion must be checked again.
  Version found_free_at = 0;
  bool is_in_question = false;
  std::uint64_t effort = 1;  // Question::effort of the next check
  int raised = 0;            // how often the effort was raised
};

// Moves to the job's start (approach.h).
struct Approaches {
  // State of the check that the job, from its start, is free of self-collisions. It is checked
  // before any arm moves there.
  enum class Feasibility { unknown, in_question, given };
  Feasibility feasibility = Feasibility::unknown;
  int tries = 0;
  std::optional<std::string> refusal = {};  // why the last move failed
  // Jobs submitted before this job, with an undecided arm (may_go_first()), that wait for this job.
  // They come after it.
  std::set<JobId> ahead_of = {};
  // A job before this one failed with Reason::deadlock. So the server moves the arms to this job's
  // start although its client did not ask for that.
  bool after_deadlock = false;

  [[nodiscard]] bool are_in_question() const { return feasibility == Feasibility::in_question; }
};

// Start of a job's age.
struct AgesFrom {
  TimePoint at;
  TimePoint clock;  // the motion clock (SpeedOverride) then
};

// Returns the fact with this member changed.
template <typename Fact, typename Member>
[[nodiscard]] Fact with(Fact fact, Member Fact::*member, std::type_identity_t<Member> value) {
  fact.*member = std::move(value);
  return fact;
}

// A motion of a job, with everything that the scheduler knows about it. The unit of admission.
struct Step {
  StepId id;
  std::shared_ptr<const Job> job;  // changed only by JobBook
  TrajectoryPtr trajectory;
  // As in Submit. `trajectory` is one of them, and may change to another until admission. Empty
  // once the arm is decided.
  std::vector<TrajectoryPtr> alternatives = {};
  WaitingLeg leg;
  StepPhase phase = Queued{};
  StepTimes times = {};
  Duration progress{};    // trajectory time, last measured
  Duration farthest{};    // MotionReport::farthest at the last rest
  double off_path = 0.0;  // Motion::off_path at its last start
  std::vector<Wait> waits_on = {};
  Asking asking = {};
  PlanRequests plans = {};
  // Its age: since it was first refused, or had its turn to move.
  std::optional<AgesFrom> ages_from = {};
  std::optional<TimePoint> overtaken_at = {};  // motion clock when another job first took its turn
  std::map<ArmId, YieldsTried> yields = {};    // by arm that could retreat for it
  Approaches approaches = {};
  // Rare members are last because every step of the scheduler reads the members above.
  std::optional<Starvation> starvation = {};  // until it is admitted
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
  // Returns the job's goal that cannot be planned because an object is too close to its arm; with
  // several candidate arms, the first such goal. Null if there is none.
  [[nodiscard]] const GoalWay* stands_in() const;
  // True if the job's end is known: its path is planned, or its goal is a joint goal of one arm.
  [[nodiscard]] bool knows_its_end() const {
    if (!is_unplanned()) return true;
    return !has_open_arm() && std::holds_alternative<Eigen::VectorXd>(goal->way().goal.to);
  }
  // True if the job has a path and a detour is being planned.
  [[nodiscard]] bool is_detour_asked() const { return plans.is_open(ForDetour{}); }
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
  // True if the job rests on its path until others have passed. False while it brakes: it may still
  // move.
  [[nodiscard]] bool pausing() const;
  // Returns the rest on its path; null if there is none, or if the job brakes.
  [[nodiscard]] const Pause* pause() const;
  // True if the job must be checked (again) before it moves.
  [[nodiscard]] bool is_waiting() const { return in<Queued>() != nullptr || in<Held>() != nullptr; }
  // True if it has passing orders.
  [[nodiscard]] bool is_admitted() const {
    return in<Admitted>() != nullptr || in<Moving>() != nullptr;
  }
  // True if its arms follow its path now, or brake on it.
  [[nodiscard]] bool is_in_motion() const {
    return in<Moving>() != nullptr || in<Braking>() != nullptr;
  }
  // True if no other motion of its arms can begin: it is in motion, or held on its path.
  [[nodiscard]] bool occupies_its_arms() const { return is_in_motion() || in<Held>() != nullptr; }
  // True if it is admitted, or still braking.
  [[nodiscard]] bool has_authority() const { return in<Admitted>() != nullptr || is_in_motion(); }
  // Precondition: the job is waiting.
  [[nodiscard]] const Judgement& judgement() const {
    const auto* held = in<Held>();
    return held != nullptr ? held->judgement : std::get<Queued>(phase).judgement;
  }

  // Returns the data of a job that brakes and then ends; null if the job goes on to its goal.
  [[nodiscard]] const Braking* ends_by_braking() const;
  // For a job that has ended.
  [[nodiscard]] std::optional<Reason> reason() const { return of_end(&Ended::reason); }
  [[nodiscard]] std::string detail() const { return of_end(&Ended::detail).value_or(""); }
  [[nodiscard]] std::optional<TimePoint> ended_at() const { return of_end(&Ended::at); }
  template <typename T>
  [[nodiscard]] std::optional<T> of_end(T Ended::*member) const {
    return has_ended() ? std::optional<T>(in<Ended>()->*member) : std::nullopt;
  }
  // True if the server moves the arms to its start when they rest elsewhere at its turn.
  [[nodiscard]] bool is_brought_to_start() const {
    return job->terms.move_to_start == MoveToStart::plan || approaches.after_deadlock;
  }
};

}  // namespace armloom

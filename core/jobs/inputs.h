#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/motion.h"
#include "core/coordination/plan_question.h"
#include "core/coordination/proximity.h"
#include "core/coordination/verdict.h"
#include "core/jobs/job_terms.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

class Policy;

// ---- Inputs: everything that can happen to the scheduler. Time comes beside them, in step(). ----

// A valid job arrives. Its id is larger than any before (Scheduler::next_job()), or that of a
// former run.
struct Submit {
  JobId job;
  TrajectoryPtr trajectory;
  JobTerms terms = {};
  // The same work by one of several arms, `trajectory` first; none, or two or more. Each moves one
  // arm, of which no other one is, and ends where it begins, unless goals are given too.
  std::vector<TrajectoryPtr> alternatives = {};
  // Where its arm is to go: the way is planned first (PlanMotion); `trajectory` is an estimate.
  // Several: one for each of `alternatives`, which are estimates.
  std::vector<MotionGoal> goals = {};
  // Active jobs that have to succeed first; smaller ids than its own.
  std::vector<JobId> after = {};
  bool system_job = false;  // the server's own: in a ring it gives way to jobs of clients
  // It waited when a former run ended: whether it can begin where its arms stand is not looked at
  // while one of them is stopped, but when they are resumed. (As of those that Interrupt keeps.)
  bool is_held_over = false;
};
struct Cancel {
  JobId job;
};
// What is asked of a job is changed, as far as it is named here (amending.h).
struct Amend {
  JobId job;
  AmendedTerms terms;
};
// Another way for this job, from where its arm stands (replanning.h). One that can be given none
// (why_not_replanned()) goes on as it is.
struct Replan {
  JobId job;
};
// The answer to the Judge effect with the same version.
struct Judged {
  Verdict verdict;
};
// The answer to the PlanMotion effect of this number.
struct PlanMade {
  JobId job;
  std::uint64_t question;
  TrajectoryPtr trajectory;  // from question.at to the goal; null: there is none
  std::string why = {};      // there is none: one sentence
  // There is none because the arm stands too close to this, which no job moves.
  std::optional<Proximity> stands_in = {};
  bool goes_through = false;  // it leads where others stand: no way past all of them was found
};
// What a controller measured of a job's motion. Sent for every job in motion at every tick that
// matters; `kind` says what has changed.
struct MotionReport {
  enum class Kind {
    progressed,  // moving; first one of a job: it has started
    stopped,     // at rest before its end, after a Brake
    finished,    // at rest at its end
    faulted,     // the controller gave up; the arm is at rest where it stands
  };
  JobId job;
  Kind kind;
  Duration progress;                   // trajectory time, as proven by measurement
  Eigen::VectorXd rest_position = {};  // stopped, finished, faulted: measured positions of the
                                       // trajectory's joints, in its order
  std::string detail = {};             // faulted: why
  // stopped, faulted: the progress of that one of its arms that got farthest; `progress` is the
  // last one's. Zero: the same.
  Duration farthest{};
};
// Stop these arms (all: every arm of the cell) and start nothing on them until Resume.
struct Stop {
  std::vector<ArmId> arms;
  std::string cause;  // "operator", or the monitor's sentence
};
struct Resume {
  std::vector<ArmId> arms;
};
// The planning scene changed: waiting jobs are judged again, and the motions under way of these
// arms (arms_in_question) are checked again.
struct SceneChanged {
  std::vector<ArmId> arms;
};
// From now on this policy decides; it is not null. Ignored while a motion is admitted: its orders
// are those of the policy that chose them.
struct ChangePolicy {
  std::shared_ptr<const Policy> policy;
};
// The server ends: every job that has not ended is interrupted; or only those that have begun,
// where the others are kept for the next run. Sent when the arms are at rest.
struct Interrupt {
  bool keeps_waiting = false;
};
// A time asked for by WakeAt has come. Every other input does the same work besides.
struct Wake {};

using Input = std::variant<Submit, Cancel, Amend, Replan, Judged, PlanMade, MotionReport, Stop,
                           Resume, SceneChanged, ChangePolicy, Interrupt, Wake>;

// ---- Effects: what the caller must do now, in this order. ----

// Answer the question, on a worker, and come back with Judged. At most one is open at a time.
struct Judge {
  Question question;
};
// Plan this job's motion, on a worker, and come back with PlanMade. Of each job and arm one is open
// at most.
struct PlanMotion {
  JobId job;
  std::uint64_t number;
  PlanQuestion question;
};
// Start (progress zero) or continue (a job that was held) this job's motion at `start_at`.
struct Dispatch {
  JobId job;
  TimePoint start_at;
  Duration from_progress;
  Duration authority;  // trajectory time that it may not pass until more is granted
};
// The job's arms may go on to here, and rest there unless more is granted in time. Never less than
// before.
struct Grant {
  JobId job;
  Duration authority;
};
// Bring this job's arms to rest on their path. A job that has not moved yet stays where it is; the
// controller answers with MotionReport::stopped in either case.
struct Brake {
  JobId job;
};
// An arm rests in `blocked_job`'s way: from now on the scheduler has a job of its own that sends it
// aside. If the arm has a job, the two wait for each other in a ring: the motion takes its place
// before that job, and behind it comes a second one, `returns`, back to where the arm stands now,
// which lets the other pass first. Said before these jobs' first JobChanged.
// to_start: none of this; it goes, by a way that is planned first, to where `blocked_job` begins.
struct YieldMove {
  JobId job;
  ArmId arm;
  JobId blocked_job;
  bool in_ring = false;
  bool returns = false;
  bool to_start = false;
};
// The job has ended and its arms are at rest: the controllers drop its motion.
struct Release {
  JobId job;
};
// Something that a client sees of this job has changed (state, progress is not one of them).
struct JobChanged {
  JobId job;
};
// Call step(Wake) not before `when` and soon after it. Replaces the time asked for before.
struct WakeAt {
  TimePoint when;
};

using Effect =
    std::variant<Judge, PlanMotion, Dispatch, Grant, Brake, YieldMove, Release, JobChanged, WakeAt>;

}  // namespace armloom

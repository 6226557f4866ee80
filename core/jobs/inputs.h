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

// ---- Inputs: everything that can happen to the scheduler. step() takes the time separately. ----

// A valid job arrives. Its id exceeds all earlier ids (Scheduler::next_job()), or belongs to an
// earlier session.
struct Submit {
  JobId job;
  TrajectoryPtr trajectory;
  JobTerms terms = {};
  // The same work by one of several arms, `trajectory` first: empty, or at least two. Each moves
  // exactly one arm, all different, and ends where it begins unless `goals` are given.
  std::vector<TrajectoryPtr> alternatives = {};
  // Goals that must be planned first (PlanMotion); `trajectory` is an estimate. If there are
  // several, one for each of `alternatives`, which are estimates.
  std::vector<MotionGoal> goals = {};
  // Active jobs that must succeed first; their ids are smaller.
  std::vector<JobId> after = {};
  bool system_job = false;  // initiated by the server: fails before client jobs in a deadlock cycle
  // The job waited when an earlier session ended (or Interrupt keeps it). Its start is not compared
  // with its arms' position while one of them is stopped.
  bool is_held_over = false;
};
struct Cancel {
  JobId job;
};
// Changes the given terms of a job (amending.h).
struct Amend {
  JobId job;
  AmendedTerms terms;
};
// Requests a new path for this job from its arm's position (replanning.h). Ignored if
// why_not_replanned() returns a reason.
struct Replan {
  JobId job;
};
// Answers the Judge effect with the same version.
struct Judged {
  Verdict verdict;
};
// Answers the PlanMotion effect with this number.
struct PlanMade {
  JobId job;
  std::uint64_t question;
  TrajectoryPtr trajectory;  // from question.at to the goal; null if there is none
  std::string why = {};      // one sentence, if there is no trajectory
  // There is no trajectory because the arm is too close to this object, which no job moves.
  std::optional<Proximity> stands_in = {};
  bool goes_through = false;  // passes other arms: no path around all of them was found
};
// Measured progress of a job's motion. Sent for every moving job in every relevant tick; `kind`
// says what changed.
struct MotionReport {
  enum class Kind {
    progressed,  // moving; the job's first report means that it started
    stopped,     // at rest before its end, after a Brake
    finished,    // at rest at its end
    faulted,     // the controller reported a fault; the arm is at rest
  };
  JobId job;
  Kind kind;
  Duration progress;                   // trajectory time, as measured
  Eigen::VectorXd rest_position = {};  // stopped, finished, faulted: measured positions of the
                                       // trajectory's joints, in its order
  std::string detail = {};             // faulted: the reason
  // stopped, faulted: progress of the foremost arm (`progress` is that of the last one). Zero if
  // equal.
  Duration farthest{};
};
// Stops these arms and starts nothing on them until Resume.
struct Stop {
  std::vector<ArmId> arms;
  std::string cause;  // "operator", or the monitor's sentence
};
struct Resume {
  std::vector<ArmId> arms;
};
// The planning scene changed: waiting jobs are checked again, and so are the motions under way of
// `arms` (arms_in_question).
struct SceneChanged {
  std::vector<ArmId> arms;
};
// Sets the policy, not null. Ignored while a motion is admitted, because its orders belong to the
// policy that chose them.
struct ChangePolicy {
  std::shared_ptr<const Policy> policy;
};
// The server ends and the arms are at rest: interrupts every job that has not ended; with
// `keeps_waiting` only jobs that have begun.
struct Interrupt {
  bool keeps_waiting = false;
};
// A time requested by WakeAt has come. Every other input does the same work as well.
struct Wake {};

using Input = std::variant<Submit, Cancel, Amend, Replan, Judged, PlanMade, MotionReport, Stop,
                           Resume, SceneChanged, ChangePolicy, Interrupt, Wake>;

// ---- Effects: what the caller must do now, in this order. ----

// Answer the question on a worker and reply with Judged. At most one is open at a time.
struct Judge {
  Question question;
};
// Plan this job's motion on a worker and reply with PlanMade. At most one is open per job and arm.
struct PlanMotion {
  JobId job;
  std::uint64_t number;
  PlanQuestion question;
};
// Start (zero progress) or continue (a stopped job) this job's motion at `start_at`.
struct Dispatch {
  JobId job;
  TimePoint start_at;
  Duration from_progress;
  Duration authority;  // trajectory time that the motion may not pass until more is granted
};
// Extends the job's authority: its arms rest there unless more is granted in time. Never decreases.
struct Grant {
  JobId job;
  Duration authority;
};
// Brake the job's arms to rest on their path, or keep them at the start. The controller always
// answers with MotionReport::stopped.
struct Brake {
  JobId job;
};
// The scheduler has added a retreat `job` because `arm` rests in `blocked_job`'s path. If the arm
// has a job, both are in a deadlock cycle (`in_ring`): the retreat goes before the arm's job,
// followed by a second job (`returns`) that brings the arm back after `blocked_job` has passed.
// With `to_start` it is a move-to-start instead: a planned path to the start of `blocked_job`.
// Reported before the first JobChanged of `job`.
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
// Something that clients see of this job has changed (progress is not included).
struct JobChanged {
  JobId job;
};
// Call step(Wake) at or soon after `when`. Replaces the previous WakeAt.
struct WakeAt {
  TimePoint when;
};

using Effect =
    std::variant<Judge, PlanMotion, Dispatch, Grant, Brake, YieldMove, Release, JobChanged, WakeAt>;

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/motion.h"
#include "core/coordination/plan_question.h"
#include "core/coordination/proximity.h"
#include "core/coordination/verdict.h"
#include "core/jobs/job_terms.h"
#include "core/jobs/shared_hold.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

struct Policy;

// ---- Inputs: everything that can happen to the scheduler. step() takes the time separately. ----

// A valid job arrives. Its id exceeds all earlier ids (Scheduler::next_job()), or belongs to an
// earlier session.
struct Submit {
  JobId job{0};
  TrajectoryPtr trajectory;
  JobTerms terms = {};
  // Trajectories by which different arms can do the same work, `trajectory` first. Empty, or at
  // least two. Each moves exactly one arm, which no other one moves. Each ends where it begins
  // unless `goals` are given.
  std::vector<TrajectoryPtr> alternatives = {};
  // Goals to which paths must be planned first (PlanMotion): `trajectory` is then an estimate.
  // Several goals: one for each of `alternatives`, which are then estimates.
  std::vector<MotionGoal> goals = {};
  // Active jobs that must succeed first; their ids are smaller.
  std::vector<JobId> after = {};
  bool system_job = false;  // initiated by the server: fails before client jobs in a deadlock cycle
  // The job was left over from an earlier session. Its start is not compared with the position of
  // its arms while one of them is stopped.
  bool is_held_over = false;
  // The job does not move before StartRecorded, and cannot overrun until then.
  bool start_is_recorded = false;
  // A motion of a task: the job of the task's first motion, which is this job itself for the first.
  std::optional<JobId> task = {};
  // Actions of its task come before this motion: it is not planned, and does not start, before
  // ActionsDone.
  bool awaits_actions = false;
  // Number of times that a motion of a task without a path awaits actions again, instead of
  // failing.
  int retries = 0;
};
// The start of a step whose job waits for it is on disk: its arms can move.
struct StartRecorded {
  StepId step;
};
// The actions before this motion of a task are done.
struct ActionsDone {
  JobId job;
  TrajectoryPtr motion = nullptr;  // instead of the job's; moves the same arms
};
struct Cancel {
  JobId job;
};
// Changes the given terms of a job. After a change of the priority, all waiting jobs are checked
// again, and the policy may choose passing orders again. Jobs that the server has added for this
// job get the same priority.
struct Amend {
  JobId job;
  AmendedTerms terms;
};
// Requests a new path for this job from its arm's position (replanning.h). Ignored if
// why_not_replanned() returns a reason.
struct Replan {
  JobId job;
};
// The answer to the open question with the same version.
struct Judged {
  Verdict verdict;
};
// Why no path was found.
struct NoPlan {
  enum class Cause {
    sought,    // there is none, or it was not found
    at_end,    // something is too close at the start or goal
    canceled,  // the search was canceled
  };
  std::string why;  // one sentence
  Cause cause = Cause::sought;
  // Set if the arm is too close to this object at the start, and no job moves the object.
  std::optional<Proximity> stands_in = {};
};
// Answers the PlanMotion effect whose `number` is `question`.
struct PlanMade {
  StepId step;
  std::uint64_t question;
  TrajectoryPtr trajectory;  // from PlanQuestion::at to the goal; null if no path was found
  NoPlan none = {};          // if no path was found
  // The path crosses positions of other arms, because no path around all of them was found.
  bool goes_through = false;
  // Set if no path past the other arms was found, except past those `left_out`.
  struct NotPast {
    std::vector<ArmId> left_out;
    NoPlan why;
  };
  std::optional<NotPast> not_past = {};
};
// Measured progress of a step's motion. Sent for every moving step in every relevant tick; `kind`
// says what changed.
struct MotionReport {
  enum class Kind {
    progressed,  // moving; the step's first report means that it started
    stopped,     // at rest before its end, after a Brake
    finished,    // at rest at its end
    faulted,     // the controller reported a fault; the arm is at rest
  };
  StepId step;
  Kind kind;
  Duration progress;                   // trajectory time, as measured
  Eigen::VectorXd rest_position = {};  // stopped, finished, faulted: measured positions of the
                                       // trajectory's joints, in its order
  std::string detail = {};             // faulted: the reason
  // stopped, faulted: progress of the arm that is farthest on the trajectory, while `progress` is
  // that of the last arm. May be zero if both are equal.
  Duration farthest{};
  // progressed: while the motion brakes, the progress at which its last arm will rest, if known.
  std::optional<Duration> rests_at = {};
};
// The authority guard has refused the step's authority for AuthorityGate::kMissing, because an arm
// is not where the passing orders assume. The step's arms brake. Its orders are decided again when
// anything changes.
struct Refused {
  StepId step;
  std::optional<ArmId> other;  // that is in the way
  std::string detail;          // one sentence
};
// Stops these arms and starts nothing on them until Resume.
struct Stop {
  struct StoppedArm {
    ArmId arm;
    std::string cause;  // "operator", or the monitor's sentence
    // Its controller has not connected yet: the stop ends then. Any other stop of the arm replaces
    // it, and stays.
    bool until_connected = false;
  };
  std::vector<StoppedArm> arms;

  explicit Stop(std::vector<StoppedArm> each) : arms(std::move(each)) {}
  // Stops all arms for the same cause.
  Stop(const std::vector<ArmId>& all, const std::string& cause) {
    for (const ArmId arm : all) arms.push_back({arm, cause});
  }
};
struct Resume {
  std::vector<ArmId> arms;
};
// An arm without authority was found at rest at `position`: it was moved while it was stopped, or
// its controller has just connected. Ends Unlocated. Otherwise ignored if the arm's job is in
// motion. A job that rests on its path is compared with the position when the arm is not stopped
// any more (rejoin()).
struct Located {
  ArmId arm;
  Eigen::VectorXd position;  // of Arm::joints, then Arm::gripper_joints
};
// The arm may be anywhere until it is located: its controller has not connected yet. Until then,
// the arms that it could meet start nothing.
struct Unlocated {
  ArmId arm;
  std::vector<ArmId> may_meet;  // other arms
};
// The planning scene changed. All waiting jobs are checked again. Admitted motions are checked
// again if they move one of `arms` (arms_in_question).
struct SceneChanged {
  std::vector<ArmId> arms;
  std::vector<SharedHold> shared_holds = {};  // all, from now on
};
// Sets the speed override of the arm, or of the cell. Precondition: SpeedOverride::is_valid(share).
struct SetSpeed {
  std::optional<ArmId> arm;
  double share;
};
// The arm keeps this share of its brake with what it holds now; 0 if it holds more than it may
// (find_overload() in core/model/payload.h).
struct SetBrake {
  ArmId arm;
  double share;
};
// A signal of the cell has changed.
struct SignalChanged {
  std::string signal;                // name
  std::optional<SignalValue> value;  // nullopt if it is not known
  std::string detail;                // why it is not known
};
// Sets the policy (not null). Ignored while a motion is admitted, because its passing orders belong
// to the policy that chose them.
struct ChangePolicy {
  std::shared_ptr<const Policy> policy;
};
// The server ends and the arms are at rest. Interrupts every job that has not ended, or with
// `keeps_waiting` only the jobs that have begun.
struct Interrupt {
  bool keeps_waiting = false;
};
// The time requested by WakeAt has come. Every other input also does the work that is due.
struct Wake {};

using Input =
    std::variant<Submit, StartRecorded, ActionsDone, Cancel, Amend, Replan, Judged, PlanMade,
                 MotionReport, Refused, Stop, Resume, Located, Unlocated, SceneChanged, SetSpeed,
                 SetBrake, SignalChanged, ChangePolicy, Interrupt, Wake>;

// ---- Effects: what the caller must do now, in this order. ----

// Answer the question on a worker and reply with Judged. At most one is open at a time.
struct Judge {
  Question question;
};
// Plan this step's motion on a worker and reply with PlanMade. At most one is open per step and
// arm.
struct PlanMotion {
  StepId step;
  std::uint64_t number;
  PlanQuestion question;
  std::optional<NoPlan> known = {};  // the answer, if it is known already
};
// At `start_at`, start this step's motion (`from_progress` is zero) or continue it after a stop.
struct Dispatch {
  StepId step;
  TimePoint start_at;
  Duration from_progress;
  Duration authority;  // trajectory time that the motion may not pass until more is granted
};
// Extends the step's authority, which never decreases. The step's arms come to rest at it unless
// more is granted in time.
struct Grant {
  StepId step;
  Duration authority;
};
// Brake the step's arms to rest on their path, or keep them at the start. The answer is a
// MotionReport of kind stopped, finished or faulted.
struct Brake {
  StepId step;
};
// The scheduler has added `job`, a job of its own for `arm`, which helps `blocked_job`. It is one
// of:
// - a retreat, because `arm` rests in the path of `blocked_job`; with `in_ring`, the arm has a job
//   in the same deadlock cycle, and the retreat goes before that job
// - a return (`returns`): in a cycle, it brings the arm back after `blocked_job` has passed;
//   otherwise to where clients left it, because `blocked_job` begins there
// - a move-to-start (`to_start`) along a planned path to the start of `blocked_job`
// Reported before the first JobChanged of `job`.
struct YieldMove {
  JobId job{0};
  ArmId arm;
  JobId blocked_job;
  bool in_ring = false;
  bool returns = false;
  bool to_start = false;
};
// The step has ended and its arms are at rest: the controllers drop its motion.
struct Release {
  StepId step;
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

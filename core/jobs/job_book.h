#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/jobs/arm_queues.h"
#include "core/jobs/job.h"
#include "core/sequence/safe_sequence.h"

namespace armloom {

// Retreats of one arm tried for a job (yield_moves.h).
struct YieldsTried {
  struct Planned {
    PathRequest request = {};
    bool is_answered = false;
    TrajectoryPtr way = nullptr;  // null if no path was found
  };
  std::size_t total = 0;  // number of tries for this job and for the server's jobs that help it
  std::size_t next = 0;   // index of the next candidate path from where `from` brought the arm
  TrajectoryPtr from;     // the motion that had brought the arm to its rest
  Planned planned = {};   // the planned retreat from there, tried last (planned_aside.h)
  // Ends of retreats made for this job and for the server's jobs that help it.
  std::vector<Eigen::VectorXd> went_to;
};

// The purpose of a server-initiated job.
struct Errand {
  JobId on_behalf_of{0};  // the client job that this job helps; a client's job helps itself
  std::optional<JobId> before = {};     // the job of the same arm that this job must precede
  std::optional<JobId> lets_pass = {};  // this job does not begin while that job waits
};

// Questions about a job.
struct Asking {
  // For admitted jobs: the version of the last check that found the motion free, and whether the
  // motion must be checked again.
  Version found_free_at = 0;
  bool is_in_question = false;
  std::uint64_t effort = 1;  // Question::effort of the next check
  int raised = 0;            // how often the effort was raised
  std::uint64_t plans = 0;   // number of plans requested
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

// A job with the scheduler's own data.
struct Record {
  Job job;
  WaitingLeg leg;
  JobId turn;  // rank among jobs: the job's own id, unless jobs were reordered
  std::optional<TimePoint> overtaken_at = {};  // motion clock when another job first took its turn
  Errand errand = {};
  // Its age: since it was first refused, or had its turn to move.
  std::optional<AgesFrom> ages_from = {};
  Duration farthest{};    // MotionReport::farthest at the last rest
  double off_path = 0.0;  // Motion::off_path at its last start
  Asking asking = {};
  std::map<ArmId, YieldsTried> yields = {};  // by arm that could retreat for this job
  Approaches approaches = {};

  // True if the server moves the job's arms to its start when they rest elsewhere at its turn.
  [[nodiscard]] bool is_brought_to_start() const {
    return job.terms.move_to_start == MoveToStart::plan || approaches.after_deadlock;
  }
};

// Checks that job ids grow, from `first` on. Smaller ids belong to jobs of earlier sessions. These
// may arrive at any time, and must grow among themselves.
class JobIds {
 public:
  explicit JobIds(JobId first) : first_(first.value()), last_(first_ - 1) {}
  // Throws std::invalid_argument if the id does not grow.
  void take(JobId id);
  [[nodiscard]] JobId next() const { return JobId{last_ + 1}; }

 private:
  std::uint64_t first_, last_;
  std::uint64_t last_former_ = 0;
};

// All jobs and their places in the arm queues. Records which published views are out of date.
class JobBook {
 public:
  JobBook(std::size_t arms, JobId first) : ids_(first), queues_(arms) {}

  // Adds a job at the end of its arms' queues, or before Errand::before in the queues that contain
  // it. Throws like JobIds::take().
  Record& add(Record record);
  [[nodiscard]] JobId next_id() const { return ids_.next(); }
  void forget(JobId job);

  [[nodiscard]] bool is_active(JobId job) const { return active_.contains(job); }
  [[nodiscard]] Record* find(JobId job);
  [[nodiscard]] const Record* find(JobId job) const;
  [[nodiscard]] Record& at(JobId job) { return records_.at(job); }
  [[nodiscard]] const Record& at(JobId job) const { return records_.at(job); }
  // Return the record of the step's job.
  [[nodiscard]] Record* find(StepId step) { return find(step.job); }
  [[nodiscard]] const Record* find(StepId step) const { return find(step.job); }
  [[nodiscard]] Record& at(StepId step) { return at(step.job); }
  [[nodiscard]] const Record& at(StepId step) const { return at(step.job); }
  // Return the jobs that have not ended: all, or only those whose state is no longer `queued`.
  // Ascending ids.
  [[nodiscard]] const std::set<JobId>& active() const { return active_; }
  [[nodiscard]] const std::vector<JobId>& past_queue() const { return past_queue_; }
  [[nodiscard]] const ArmQueues& queues() const { return queues_; }
  // Reorders waiting jobs that occupy consecutive places on the same arms.
  void put_in_order(const std::vector<JobId>& jobs);
  // Moves a waiting job to another arm, at position `place` of that arm's queue.
  void take(Record& record, TrajectoryPtr trajectory, WaitingLeg leg, std::size_t place);
  // Sets the planned or a new path. Precondition: the job waits in the queue.
  void set_motion(Record& record, TrajectoryPtr trajectory, WaitingLeg leg);
  // Precondition: the job has not ended.
  void set_priority(Record& record, int priority);
  // Replaces one of the job's alternatives. If the job has this one now, its motion changes too.
  void set_alternative(Record& record, std::size_t which, TrajectoryPtr trajectory, WaitingLeg leg);
  // Assigns the job to its present arm for good. Precondition: the job is waiting.
  void decide_arm(Record& record);
  [[nodiscard]] bool has_goals() const { return goals_ > 0; }
  // Returns the queued jobs that could still run on other arms.
  [[nodiscard]] const std::set<JobId>& undecided() const { return undecided_; }
  // The jobs whose replanning has begun. A reader removes those that are no longer replanned.
  [[nodiscard]] std::set<JobId>& being_replanned() { return being_replanned_; }
  // Returns true if all active jobs have the same priority.
  [[nodiscard]] bool all_as_urgent() const { return priorities_.size() <= 1; }

  // Throws std::logic_error for transitions that are not in the table of job.h.
  void enter(Record& record, JobPhase phase);
  // Moves the job to Ended and out of the queues. Returns the active jobs that named it in `after`.
  [[nodiscard]] std::vector<JobId> end(Record& record, Ended how);
  void set_waits(Record& record, std::span<const Wait> waits);
  void set_wait(Record& record, const Wait& only) { set_waits(record, {&only, 1}); }

  // Mark a job whose published view or wait explanation is out of date.
  void changed(const Record& record) { news_.changed.insert(record.job.id); }
  void explain(const Record& record) { news_.unexplained.insert(record.job.id); }
  struct News {
    std::set<JobId> changed = {};
    std::set<JobId> unexplained = {};
  };
  // The changes since the publisher last took them out.
  [[nodiscard]] News& news() { return news_; }

 private:
  void explain_with_next(const Job& job);

  std::unordered_map<JobId, Record> records_;
  JobIds ids_;
  std::set<JobId> active_;
  std::vector<JobId> past_queue_;  // few, ascending
  std::set<JobId> undecided_;
  std::set<JobId> being_replanned_;
  std::size_t goals_ = 0;
  std::map<JobId, std::vector<JobId>> followers_;  // jobs that name the key in Submit::after
  std::map<int, std::size_t> priorities_;          // number of active jobs per priority
  ArmQueues queues_;
  News news_;
};

// Returns the jobs that are admitted, braking or held.
[[nodiscard]] std::vector<const Job*> occupying(const JobBook& book);
// Returns true if the job first lets another job pass that waits.
[[nodiscard]] bool lets_another_pass(const JobBook& book, const Record& record);
// Returns these jobs sorted by Record::turn, except that jobs of the same arm keep the order of its
// queue.
[[nodiscard]] std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs);

}  // namespace armloom

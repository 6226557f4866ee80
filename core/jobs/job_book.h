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
    std::optional<std::uint64_t> question = {};  // number of the open question
    bool is_answered = false;
    TrajectoryPtr way = nullptr;  // null if no path was found
  };
  std::size_t total = 0;  // all tries, for a job that it helps too
  std::size_t next = 0;   // index into the candidate paths from the rest after `from`
  TrajectoryPtr from;
  Planned planned = {};                  // the last candidate from there (planned_aside.h)
  std::vector<Eigen::VectorXd> went_to;  // ends, for a job that it helps too
};

// The purpose of a server-initiated job.
struct Errand {
  JobId on_behalf_of{0};             // the client job that it helps; its own id for a client's job
  std::optional<JobId> before = {};  // the job of the same arm that it precedes
  std::optional<JobId> lets_pass = {};  // it does not begin while this job waits
};

// Questions about a job.
struct Asking {
  // For admitted jobs: the version of the last check that found the motion free, and true if the
  // motion must be checked again before it starts.
  Version found_free_at = 0;
  bool is_in_question = false;
  std::uint64_t effort = 1;  // Question::effort of the next check
  int raised = 0;            // how often the effort was raised
  std::uint64_t plans = 0;   // number of plans requested
};

// Moves to the job's start (approach.h).
struct Approaches {
  // Is the job feasible from its start? Checked before any arm moves there.
  enum class Feasibility { unknown, in_question, given };
  Feasibility feasibility = Feasibility::unknown;
  int tries = 0;
  std::optional<std::string> refusal = {};
  // Earlier jobs with an undecided arm (may_go_first()) that wait for this job: it precedes them.
  std::set<JobId> ahead_of = {};
  // The job before it failed with Reason::deadlock: its arms are moved to its start without a
  // request by its client.
  bool after_deadlock = false;

  [[nodiscard]] bool are_in_question() const { return feasibility == Feasibility::in_question; }
};

// A job with the scheduler's own data.
struct Record {
  Job job;
  WaitingLeg leg;
  JobId turn;  // its rank in submission order: its own id, unless jobs were reordered
  std::optional<TimePoint> overtaken_at = {};  // when another job first took its turn
  Errand errand = {};
  std::optional<TimePoint> ages_from = {};  // when it was first in conflict or without a place
  Duration farthest{};                      // MotionReport::farthest at the last rest
  double off_path = 0.0;                    // Motion::off_path at its last start
  Asking asking = {};
  std::map<ArmId, YieldsTried> yields = {};  // arms that could retreat for it
  Approaches approaches = {};

  // True if its arms are moved to its start, in case they rest elsewhere at its turn.
  [[nodiscard]] bool is_brought_to_start() const {
    return job.terms.move_to_start == MoveToStart::plan || approaches.after_deadlock;
  }
};

// Checks job ids: they grow from `first`; smaller ids belong to jobs of earlier sessions, which may
// arrive at any time and grow by themselves.
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
  // Active jobs: all; those whose state is not `queued`. In order of submission.
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
  // For any alternative, also the present one.
  void set_alternative(Record& record, std::size_t which, TrajectoryPtr trajectory, WaitingLeg leg);
  // Assigns the job to its present arm. Precondition: the job is waiting.
  void decide_arm(Record& record);
  [[nodiscard]] bool has_goals() const { return goals_ > 0; }
  // Waiting jobs that could still run on other arms.
  [[nodiscard]] const std::set<JobId>& undecided() const { return undecided_; }
  // Jobs that were being replanned when inserted; some may have ended.
  [[nodiscard]] std::set<JobId>& being_replanned() { return being_replanned_; }
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
  // The publisher takes the news out.
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
// Returns true if the job is the first of its arms, all jobs in `after` have ended, and it lets no
// other job pass.
[[nodiscard]] bool is_at_head(const JobBook& book, const Record& record);
[[nodiscard]] bool lets_another_pass(const JobBook& book, const Record& record);
// Returns the same jobs sorted by turn, but in the order of each arm's queue.
[[nodiscard]] std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs);

}  // namespace armloom

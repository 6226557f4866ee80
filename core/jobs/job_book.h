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

// Ways out of another job's way that have been tried for it with one arm (yield_moves.h).
struct YieldsTried {
  struct Planned {
    std::optional<std::uint64_t> question = {};  // that is open: its number
    bool is_answered = false;
    TrajectoryPtr way = nullptr;  // null: there is none
  };
  std::size_t total = 0;  // for all that helps the job too
  std::size_t next = 0;   // of the ways from where the arm came to rest by `from`
  TrajectoryPtr from;
  Planned planned = {};                  // from there, the last of these ways (planned_aside.h)
  std::vector<Eigen::VectorXd> went_to;  // for all that helps the job too
};

// Of a job that the scheduler has made: what it is to do for whom.
struct Errand {
  JobId on_behalf_of{0};                // the client's job that it is to help; else itself
  std::optional<JobId> before = {};     // it took its place before this one of its arm
  std::optional<JobId> lets_pass = {};  // and does not begin while this one waits
};

// The questions that are asked about a job.
struct Asking {
  // For admitted jobs: the version of the last check that found the motion free; and true if the
  // motion has to be checked again before it starts.
  Version found_free_at = 0;
  bool is_in_question = false;
  std::uint64_t effort = 1;  // Question::effort of the next time that it is judged
  int raised = 0;            // how often that was raised
  std::uint64_t plans = 0;   // so many have been asked for it
};

// How often arms were sent to where a job begins (approach.h), and why there is no way there.
struct Approaches {
  // Whether the job could run at all from there, which is asked before anything moves for it.
  enum class Feasibility { unknown, in_question, given };
  Feasibility feasibility = Feasibility::unknown;
  int tries = 0;
  std::optional<std::string> refusal = {};
  // Earlier jobs with an open arm (may_go_first()) that wait for this one: it goes before them.
  std::set<JobId> ahead_of = {};
  // The job before it failed with Reason::deadlock: its arms are brought to its start, though its
  // client did not ask for that.
  bool after_deadlock = false;

  [[nodiscard]] bool are_in_question() const { return feasibility == Feasibility::in_question; }
};

// A job, and what only the scheduler knows of it.
struct Record {
  Job job;
  WaitingLeg leg;
  JobId turn;  // whose place in the order of submission it has: its own, unless jobs changed places
  std::optional<TimePoint> overtaken_at = {};  // first, by one that took its turn
  Errand errand = {};
  std::optional<TimePoint> ages_from = {};  // first in conflict, or first without a place
  Duration farthest{};                      // MotionReport::farthest of the last rest
  double off_path = 0.0;                    // Motion::off_path, as it set out last
  Asking asking = {};
  std::map<ArmId, YieldsTried> yields = {};  // of arms that could make way for it
  Approaches approaches = {};

  // Its arms are brought to where it begins, if they stand elsewhere at its turn.
  [[nodiscard]] bool is_brought_to_start() const {
    return job.terms.move_to_start == MoveToStart::plan || approaches.after_deadlock;
  }
};

// Which ids jobs may come with: they grow, from `first` on; the ones below are those of former
// runs, whose jobs may come too, at any time, and grow by themselves.
class JobIds {
 public:
  explicit JobIds(JobId first) : first_(first.value()), last_(first_ - 1) {}
  // Throws std::invalid_argument.
  void take(JobId id);
  [[nodiscard]] JobId next() const { return JobId{last_ + 1}; }

 private:
  std::uint64_t first_, last_;
  std::uint64_t last_former_ = 0;
};

// All jobs, and their places in the queues of their arms. Changes of what clients see are noted.
class JobBook {
 public:
  JobBook(std::size_t arms, JobId first) : ids_(first), queues_(arms) {}

  // Throws as JobIds::take(). It comes to the end of its arms' queues, or before
  // record.errand.before where that stands.
  Record& add(Record record);
  [[nodiscard]] JobId next_id() const { return ids_.next(); }
  // Precondition: it has ended.
  void forget(JobId job);

  [[nodiscard]] bool is_active(JobId job) const { return active_.contains(job); }
  [[nodiscard]] Record* find(JobId job);
  [[nodiscard]] const Record* find(JobId job) const;
  [[nodiscard]] Record& at(JobId job) { return records_.at(job); }
  [[nodiscard]] const Record& at(JobId job) const { return records_.at(job); }
  // All that have not ended; of these, all that were judged. In order of submission.
  [[nodiscard]] const std::set<JobId>& active() const { return active_; }
  [[nodiscard]] const std::vector<JobId>& past_queue() const { return past_queue_; }
  [[nodiscard]] const ArmQueues& queues() const { return queues_; }
  // These follow each other on the same arms and wait: now in this order.
  void put_in_order(const std::vector<JobId>& jobs);
  // By another arm, before which so many of that one's jobs stand. Precondition: it waits.
  void take(Record& record, TrajectoryPtr trajectory, WaitingLeg leg, std::size_t place);
  // Its way is known now, or is another one. Precondition: it waits in the queue.
  void set_motion(Record& record, TrajectoryPtr trajectory, WaitingLeg leg);
  // Precondition: it has not ended.
  void set_priority(Record& record, int priority);
  // The same of one of its alternatives, the one that it is taken to go by or another.
  void set_alternative(Record& record, std::size_t which, TrajectoryPtr trajectory, WaitingLeg leg);
  // It goes by the arm that it has now, and no other one. Precondition: it waits.
  void decide_arm(Record& record);
  // Any that say where to go.
  [[nodiscard]] bool has_goals() const { return goals_ > 0; }
  // That could still go on other arms.
  [[nodiscard]] const std::set<JobId>& undecided() const { return undecided_; }
  // Job::is_replanned_now(), or were when they were put there; some may have ended.
  [[nodiscard]] std::set<JobId>& being_replanned() { return being_replanned_; }
  [[nodiscard]] bool all_as_urgent() const { return priorities_.size() <= 1; }

  // A transition of the table in job.h; any other one throws std::logic_error.
  void enter(Record& record, JobPhase phase);
  // Into Ended, and out of the queues. Active jobs that named it in `after`.
  [[nodiscard]] std::vector<JobId> end(Record& record, Ended how);
  void set_waits(Record& record, std::span<const Wait> waits);
  void set_wait(Record& record, const Wait& only) { set_waits(record, {&only, 1}); }

  // For clients, or for whoever explains waits: it, or what is before it, is not as it was told.
  void changed(const Record& record) { news_.changed.insert(record.job.id); }
  void explain(const Record& record) { news_.unexplained.insert(record.job.id); }
  struct News {
    std::set<JobId> changed = {};
    std::set<JobId> unexplained = {};
  };
  // Whoever tells them takes them out.
  [[nodiscard]] News& news() { return news_; }

 private:
  void explain_with_next(const Job& job);

  std::unordered_map<JobId, Record> records_;
  JobIds ids_;
  std::set<JobId> active_;
  std::vector<JobId> past_queue_;  // few: ascending
  std::set<JobId> undecided_;
  std::set<JobId> being_replanned_;
  std::size_t goals_ = 0;
  std::map<JobId, std::vector<JobId>> followers_;  // those that name it in Submit::after
  std::map<int, std::size_t> priorities_;          // how many active jobs have it
  ArmQueues queues_;
  News news_;
};

// Those that are admitted or held on their paths.
[[nodiscard]] std::vector<const Job*> occupying(const JobBook& book);
// Nothing of its own keeps it waiting: first of its arms, all in `after` ended, none let pass.
[[nodiscard]] bool is_at_head(const JobBook& book, const Record& record);
[[nodiscard]] bool lets_another_pass(const JobBook& book, const Record& record);
// Returns the same jobs by turn, in the order of each arm's queue.
[[nodiscard]] std::vector<JobId> in_turn(const JobBook& book, const std::set<JobId>& jobs);

}  // namespace armloom

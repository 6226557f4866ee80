#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/scheduler/deadlock.h"
#include "core/scheduler/inputs.h"
#include "core/scheduler/job.h"
#include "core/scheduler/policy.h"
#include "core/scheduler/precedence_graph.h"
#include "core/scheduler/safe_sequence.h"

namespace armloom {

// A motion that takes longer than execution.duration_scaling and _margin allow overruns only when
// it has not moved for this long: one that is slow or late comes to its end, and to end it earlier
// would free nobody's way.
inline constexpr Duration kStandstill = std::chrono::seconds(10);

// The pure heart: queue, backlog, lanes and orders, stops. A deterministic state machine without
// threads, clock, sockets or geometry. Admission and the orders that it makes are one step: a job
// that is admitted has its place in the precedence graph before step() returns, and no other
// judgement is open.
//
// What is admitted, under every policy, is a motion in that graph (precedence_graph.h): it is
// granted authority as far as the orders let it, and waits at its start or pauses on its way where
// they do not. The policy chooses the orders; nothing that moves counts on times, so that late arms
// disturb nobody, and braking ones need not be waited for. Under timed_discrete there are none.
//
// Whatever changes what is admitted, or where arms rest, makes a new version: a verdict on an older
// one is void and asked again, and every waiting job is tried again on the new one.
//
// Whose turn it is: held jobs first, then the larger priority, where a job that others wait for is
// as urgent as the most urgent of them, then the earlier. A job that has waited for
// scheduling.aging since it was first in conflict, or first without a place, holds back every other
// one but those that have to go before it, unless what it waits for is an arm that no job moves, an
// object or a stop (README.md: how long can a job be overtaken).
//
// Jobs that wait for each other in a ring can never move: each is told its ring in the step that
// finds it. Then an arm of the ring goes aside and comes back when the other has passed, if the
// cell says so and there is such a way; else the job that was submitted last fails.
//
// An arm that comes to rest off its plan (canceled, faulted) holds those that would pass there
// where they may be. A scene that changes may endanger motions that were admitted before: these are
// judged again, and those in conflict are held until the way is free.
//
// An arm without a job that rests in a job's way is sent aside, if the cell says so, too. Either is
// done by jobs of the caller's own (MoveAside).
class Scheduler {
 public:
  // `rest` is where every joint stands at the beginning. The policy is not null.
  Scheduler(CellPtr cell, std::unique_ptr<const Policy> policy, Configuration rest);

  // Time never goes backwards (throws std::invalid_argument). An input that names an unknown or
  // ended job is ignored. Effects are to be carried out in order.
  [[nodiscard]] std::vector<Effect> step(const Input& input, TimePoint now);

  // Where every joint stands, as far as it is not in motion; there where it set out.
  [[nodiscard]] const Configuration& rest() const { return rest_; }
  // Where every joint will stand when all accepted jobs have succeeded: a new job has to begin
  // there.
  [[nodiscard]] Configuration predicted_rest() const;

  [[nodiscard]] const Policy& policy() const { return *policy_; }
  // For a Trial. What is open is asked anew.
  void forget_question() { open_.reset(); }
  // By the clock, of the one candidate of a question that is open: when it could begin beside what
  // is admitted, from now. Nothing: not, as things stand.
  [[nodiscard]] std::optional<Duration> earliest_start(const Question& question,
                                                       const Verdict& verdict) const;

  [[nodiscard]] const Job* find(JobId job) const;   // null: unknown or forgotten
  [[nodiscard]] std::vector<JobId> active() const;  // all not ended, in order of submission
  [[nodiscard]] bool stopped(ArmId arm) const;
  [[nodiscard]] std::optional<JobId> occupant(ArmId arm) const;  // in motion or held on this arm
  // Ended jobs are kept until forgotten, so that the caller can read how they ended.
  void forget(JobId ended);

 private:
  enum class AfterStop { hold, cancel, fail };
  struct AsidesTried {
    std::size_t total = 0;  // for all that helps the job too
    std::size_t next = 0;   // of the ways from where the arm came to rest by `from`
    TrajectoryPtr from;
    std::vector<Eigen::VectorXd> went_to;  // for all that helps the job too
  };
  struct Record {
    Job job;
    WaitingLeg leg;
    AfterStop after_stop = AfterStop::hold;
    Reason fail_reason = Reason::overrun;  // with AfterStop::fail
    std::string fail_detail;
    Version judged_at = 0;                // the version on which it was last found in conflict
    std::vector<Wait> found;              // with what
    std::optional<TimePoint> ages_from;   // first in conflict, or first without a place
    Version checked_at = 0;               // in motion: the version on which it was last found free
    Duration farthest{};                  // MotionReport::farthest of the last rest
    std::optional<TimePoint> overrun_at;  // if it does not move before
    TimePoint moved_at{};                 // last
    std::optional<TimePoint> in_vain_since;  // on its path, for what no job moves
    bool dispatched = false;  // the arms have the motion; else it is scheduled at most
    std::map<ArmId, AsidesTried> asides_tried;  // of arms that could make way for it
    Duration horizon{};              // how far ahead of its progress its authority may reach
    JobId helps{0};                  // Submit::helps, and what that helps; else itself
    std::optional<JobId> before;     // Submit::before
    std::optional<JobId> lets_pass;  // Submit::lets_pass
    std::uint64_t effort = 1;        // Question::effort of the next time that it is judged
    int raised = 0;                  // how often that was raised
  };
  // A job that has waited for longer than scheduling.aging, and all that have to go before it.
  struct Aged {
    JobId job;
    std::vector<JobId> goes_first;  // ascending
  };
  struct NamedRing {
    Ring ring;
    Version disturbed_at;
    bool way_out = false;  // an arm of it may go aside
    bool opens = false;    // and does
  };
  enum class Purpose {
    start,    // of a job that waits
    recheck,  // of a motion that is under way or scheduled
    aside,    // whether an arm could go aside, and the job then pass
  };
  struct Aside {
    JobId way_of;
    ArmId arm;
    TrajectoryPtr way;
    std::optional<JobId> before = {};  // MoveAside::before
    bool is_free = false;              // the way; else that is the question
    std::size_t index = 0;             // of the ways from where the arm rests
  };
  struct OpenQuestion {
    Version version;
    std::vector<JobId> jobs;
    Purpose purpose;
    std::optional<Aside> aside = {};
    std::vector<Passage> passages = {};  // Question::passages
  };

  // Policies that admit groups: everything that waits is tried as one; if that fails, these alone.
  struct Together {
    Version version;
    std::vector<JobId> alone;
  };

  // scheduler.cc: what happens to jobs
  void on(const Submit& input);
  void take_place(JobId job, JobId before);
  void on(const Judged& input);
  void on(const MotionReport& input);
  void on(const SceneChanged& input);
  void on(const Interrupt& input);
  void on(const Wake& input);
  void progress(Record& record);
  void forget_predecessor(JobId ended, bool succeeded);
  void set_state(Record& record, JobState state);
  void end(Record& record, JobState state, Reason reason, std::string detail);
  void settle();  // deadlines, waits, the next question, the next wake
  void changed(const Record& record) { changed_.insert(record.job.id); }

  // stopping.cc
  void brake(Record& record, AfterStop then);
  void withdraw(Record& record, AfterStop then);
  void come_to_rest(Record& record, const MotionReport& report);
  void on(const Cancel& input);
  void on(const Stop& input);
  void on(const Resume& input);

  // deadlines.cc
  void expire_and_overrun();
  void see_whether_in_vain(Record& record) const;
  void give_up(Record& record);
  void expect_end(Record& record, TimePoint start_at) const;
  [[nodiscard]] bool overruns(Record& record) const;
  void ask_for_wake();

  // admission.cc: who may be judged, and what is asked
  void form_round();
  [[nodiscard]] bool ask_next();
  [[nodiscard]] bool may_be_judged(const Record& record,
                                   const std::vector<const Job*>& occupying) const;
  [[nodiscard]] std::optional<Wait> stop_of(const Record& record) const;
  [[nodiscard]] std::optional<Wait> capacity_of(const Record& record,
                                                const std::vector<const Job*>& occupying) const;
  void fail_impossible_starts();
  [[nodiscard]] std::optional<std::string> start_mismatch(const Trajectory& trajectory) const;
  [[nodiscard]] std::optional<JobId> next_recheck() const;
  [[nodiscard]] std::optional<JobId> next_candidate() const;
  void ask(std::vector<JobId> jobs, Purpose purpose);
  [[nodiscard]] Motion motion_now(const Record& record) const;
  void add_others(Question& question, const std::vector<JobId>& candidates) const;

  // turns.cc: whose turn it is among waiting jobs
  // The same jobs, each after those before it.
  [[nodiscard]] std::vector<JobId> in_turn(const std::set<JobId>& jobs) const;
  [[nodiscard]] bool lets_another_pass(const Record& record) const;
  void explain_waits();
  [[nodiscard]] std::optional<Wait> order_of(const Record& record) const;
  [[nodiscard]] std::vector<Wait> found_in_the_way(const Record& record) const;
  [[nodiscard]] WaitsFor waits_for() const;
  [[nodiscard]] std::optional<JobId> has_to_move_first(const Wait& wait) const;
  [[nodiscard]] std::map<JobId, int> urgencies() const;  // empty: all are the same
  [[nodiscard]] bool is_aged(const Record& record) const;
  [[nodiscard]] bool waits_beyond_turns(const Record& record) const;
  [[nodiscard]] std::vector<Aged> aged_jobs() const;  // that hold others back, the oldest first
  [[nodiscard]] std::optional<JobId> held_back_by(const Record& record,
                                                  const std::vector<Aged>& aged) const;

  // rings.cc
  void name_deadlocks();
  void settle_deadlocks();
  [[nodiscard]] bool stands(const NamedRing& named) const;
  [[nodiscard]] bool is_counted_on(const Record& own) const;
  void resolve(const Ring& ring);
  void untell(const Ring& ring);

  [[nodiscard]] std::vector<const Job*> occupying() const;  // scheduled, in motion, held
  [[nodiscard]] bool at_head(const Record& record) const;
  [[nodiscard]] bool holds_reservation(const Record& record) const;
  [[nodiscard]] static bool waiting(const Record& record);
  void set_waits(Record& record, std::vector<Wait> waits);

  // lanes.cc
  [[nodiscard]] WaitingLeg leg_of(const Job& job);
  void rest_where_it_stands(ArmId arm);
  void rest_at_goal(const Record& record);
  void follow_lanes(const Job& job, JobState before);
  void renew_lanes();
  [[nodiscard]] SafeSequence::Outlook outlook_after(const std::vector<JobId>& jobs);
  [[nodiscard]] bool waits_for_sequence(JobId job);
  void wait_in_turn(Record& record, JobId first);
  [[nodiscard]] bool leaves_a_sequence(const std::vector<JobId>& jobs);
  void add_passages(Question& question, std::vector<Passage> unknown);
  void learn(const OpenQuestion& question, const Verdict& verdict);
  void learn_in_the_way(JobId job, ArmId arm);

  // moving_aside.cc
  [[nodiscard]] std::optional<Aside> next_aside() const;
  [[nodiscard]] std::optional<Aside> next_aside_in_a_ring() const;
  [[nodiscard]] std::optional<Aside> aside_in(const Ring& ring) const;
  [[nodiscard]] std::optional<Aside> untried(const Record& record, ArmId arm) const;
  [[nodiscard]] Question about_way(TrajectoryPtr way) const;
  void ask_aside(Aside aside);
  void answer_aside(const Verdict& verdict, Aside aside);
  [[nodiscard]] bool lets_through(const Verdict& verdict, const Aside& aside) const;
  void move_aside(const Aside& aside);

  // answer.cc: what it means
  void answer(const Verdict& verdict, const OpenQuestion& question);
  [[nodiscard]] CoordinatedMotion coordinated(const Record& record) const;
  [[nodiscard]] bool tries_together(const OpenQuestion& question, bool can_go);
  [[nodiscard]] std::vector<JobId> with_all_that_wait(const std::vector<JobId>& group) const;
  [[nodiscard]] std::set<JobId> first_of_arms(const std::vector<JobId>& group) const;
  void admit(const std::vector<JobId>& jobs, const PassingOrders& orders);
  [[nodiscard]] std::vector<JobId> with_next_jobs(const std::vector<JobId>& group,
                                                  const std::vector<ArmId>& in_the_way) const;
  [[nodiscard]] bool may_follow(const Record& record) const;
  [[nodiscard]] bool is_asked_again(Record& record, const Verdict& verdict) const;
  void refuse(Record& record, const Verdict& verdict, bool recheck);
  void put_off(Record& record, std::vector<Wait> waits);

  // authority.cc: how far what is admitted may go
  void dispatch_ready();
  void dispatch_if_ready(Record& record);
  void extend_authority(JobId moved);
  void extend_own_authority(Record& record);
  void explain_pause(Record& record);
  [[nodiscard]] std::optional<Wait> held_where_it_stands(const Record& record) const;
  [[nodiscard]] bool stands(const Record& record) const;
  void see_pauses(Record& record, Duration progress_before);
  void leave_graph(const Record& record);

  CellPtr cell_;
  std::shared_ptr<const Policy> policy_;
  Configuration rest_;
  std::map<JobId, Record> records_;
  std::set<JobId> active_;
  std::set<JobId> past_queue_;   // of these, all that are more than queued
  std::set<JobId> unexplained_;  // new, or another one stands before it than when it was told
  std::map<JobId, std::vector<JobId>> followers_;    // those that name it in Submit::after
  std::map<int, std::size_t> priorities_;            // how many active jobs have it
  std::vector<Duration> work_;                       // per arm: of its active jobs
  std::vector<std::deque<JobId>> order_;             // per arm: active jobs, first goes first
  std::vector<std::optional<std::string>> stopped_;  // per arm: the cause
  std::vector<TrajectoryPtr> came_by_;  // per arm: the motion on which it came to rest; or null
  Places places_;
  std::vector<PlacePtr> rests_at_;  // per arm: where it rests, or came from
  SafeSequence sequence_;           // of all that waits in the queue
  bool lanes_changed_ = true;       // otherwise than the sequence knows
  Version version_ = 1;
  Version disturbed_at_ = 0;  // the last time that the scene became another one
  std::set<JobId> round_;     // policies with rounds: the jobs of the present one
  bool round_begun_ = false;
  std::vector<NamedRing> rings_;  // told in an earlier step
  std::optional<OpenQuestion> open_;
  std::optional<Together> together_;
  PrecedenceGraph graph_;  // all that is admitted
  std::optional<TimePoint> wake_at_;

  TimePoint now_{};              // of the present step
  std::vector<Effect> effects_;  // of the present step
  std::set<JobId> changed_;      // in the present step
};

}  // namespace armloom

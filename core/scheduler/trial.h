#pragma once

#include <optional>
#include <set>
#include <vector>

#include "core/scheduler/scheduler.h"

namespace armloom {

// Finds the outcome of a job if it were submitted now. Runs a copy of the scheduler, at constant
// time and with real answers to its questions. The trial ends when the job has had its turn and any
// deadlock cycle that it closes is resolved. So the outcome is what the scheduler itself would
// decide. Pure.
//
//   while (true) {
//     if (auto question = trial.next()) trial.answer(verdict);
//     else if (auto plan = trial.next_plan()) trial.answer(plan made);
//     else break;
//   }
class Trial {
 public:
  // The scheduler's questions that are open when the trial begins.
  struct Open {
    std::optional<Question> question = {};
    std::vector<PlanMotion> plans = {};
  };
  // Submits `jobs` to the copy in this order. The trial is about the job `asked`, which is one of
  // them. `behind`: further motions of its task, each after the one before; their ids are set here.
  Trial(Scheduler scheduler, Open open, const std::vector<Submit>& jobs, JobId asked, TimePoint now,
        std::vector<Submit> behind = {});

  // Returns the question to be answered next; nullopt if a plan is needed or the outcome is known.
  [[nodiscard]] std::optional<Question> next() const;
  void answer(Verdict verdict);
  // Returns the plan to be made next; nullopt if the outcome is known. Precondition: next() returns
  // nullopt.
  [[nodiscard]] std::optional<PlanMotion> next_plan() const;
  void answer(const PlanMade& made);

  struct Outcome {
    Verdict::Kind kind;
    // From now; if the job is not admitted: the earliest start by the clock.
    std::optional<Duration> starts_in;
    std::vector<Wait> waits;  // of an admitted job: what it waits for until it starts
    std::optional<ClearanceBound> clearance_bound;
    std::uint64_t evaluations = 0;  // of all questions about the job
    // If its arms are moved to its start: time until they are there.
    std::optional<Duration> approach = {};
    std::set<JobId> added = {};     // jobs of the server, which exist only in the trial
    std::optional<Step> step = {};  // of the job: its final state in the trial
  };
  // Returns the outcome. Precondition: next() and next_plan() return nullopt. If the arms must
  // first be moved to the job's start, the job may not be admitted together with that motion. The
  // outcome then describes that motion, because the job itself is checked at its turn.
  [[nodiscard]] Outcome outcome() const;

  // Limits of a trial. If the job would wait for more checks or plans, the outcome has the waits
  // found so far.
  static constexpr int kJudgementsMax = 500;
  static constexpr int kPlansMax = 20;

 private:
  void step(const Input& input);
  [[nodiscard]] bool is_in_ring() const;
  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool is_on_its_way() const;
  [[nodiscard]] Duration approach_ends() const;
  [[nodiscard]] std::vector<Wait> waits() const;

  Scheduler scheduler_;
  JobId job_;
  TimePoint now_;
  Open open_;
  std::set<JobId> added_;          // by the server, in the trial
  std::vector<JobId> approaches_;  // of these: moves to the job's start
  int judgements_ = 0;
  int plans_ = 0;
  std::optional<Verdict> last_;       // about the job, alone or with others
  std::optional<Duration> by_clock_;  // its earliest start by the clock, as last found
  std::vector<Wait> waits_;           // as last published
  std::uint64_t evaluations_ = 0;
};

// Returns a scheduler for a trial in which these arms have ended their jobs and rest at `at`
// (positions of all joints). Other arms are as in `present`: in motion, at rest, stopped. Jobs that
// wait are left out.
[[nodiscard]] Scheduler with_arms_at(const Scheduler& present, const CellPtr& cell,
                                     const std::vector<ArmId>& arms, const Configuration& at,
                                     TimePoint now);

}  // namespace armloom

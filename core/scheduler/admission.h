#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"
#include "core/scheduler/waiting/choosing.h"
#include "core/scheduler/waiting/turns.h"
#include "core/scheduler/waiting/wait_cycles.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Asks geometry one question at a time and handles the answer: jobs are admitted with passing
// orders, more is asked, or jobs wait. Admission and the resulting orders are one step.
class Admission {
 public:
  // Asks the next question if none is open, in this order: motions that a changed scene may
  // endanger; jobs to be moved to their start (are they feasible from there?); retreats that could
  // open a deadlock cycle; jobs whose turn it is; other retreats. Returns true if jobs were
  // deferred meanwhile, because this changes the waits. `turns` must be current.
  [[nodiscard]] bool ask_next(State& state, const Turns& turns, const WaitCycles& cycles);
  // Handles the answer to the open question. An answer for an older version is void; the question
  // is asked again.
  void on(const Judged& input, State& state, WaitCycles& cycles);

 private:
  enum class Purpose {
    start,    // of a waiting job
    option,   // the same, for one of several options of a turn
    itself,   // a job alone, from its start, although its arms are elsewhere
    recheck,  // a motion that is under way or scheduled
    yield,    // can an arm retreat, and does the job then pass?
  };
  struct OpenQuestion {
    Version version;
    std::vector<JobId> jobs;
    Purpose purpose;
    std::optional<YieldTrial> yield = {};
    std::vector<Passage> passages = {};  // Question::passages
    bool is_only_option = false;         // no other option could take the turn
  };
  // For policies that admit groups: all waiting jobs are tried as one group; if that fails,
  // `alone`.
  struct Together {
    Version version;
    std::vector<JobId> alone;
  };

  void ask(State& state, std::vector<JobId> jobs, SafeSequence::Outlook outlook,
           Purpose purpose = Purpose::start);
  void ask_about(State& state, JobId job, Question question, Purpose purpose);
  void ask_yield(State& state, YieldTrial move);
  void answer_yield(State& state, const Verdict& verdict, YieldTrial move, WaitCycles& cycles);
  void answer_option(State& state, Verdict verdict);
  void answer_start(State& state, const Verdict& verdict, const std::vector<JobId>& jobs);
  void decide(State& state, const Verdict& verdict, const std::vector<JobId>& jobs);
  [[nodiscard]] bool leaves_a_sequence(State& state, const std::vector<JobId>& jobs);
  [[nodiscard]] bool tries_together(State& state, const std::vector<JobId>& jobs, bool can_go);

  std::optional<OpenQuestion> open_;
  Choosing choosing_;
  std::optional<Together> together_;
};

}  // namespace armloom

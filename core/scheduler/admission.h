#pragma once

#include <optional>
#include <vector>

#include "core/jobs/state.h"
#include "core/scheduler/waiting/choosing.h"
#include "core/scheduler/waiting/turns.h"
#include "core/scheduler/waiting/wait_cycles.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// What is asked of geometry, one question at a time, and what an answer means: these go, with these
// orders; or more is asked; or they wait. Admission and the orders that it makes are one step.
class Admission {
 public:
  // The next question, if none is open: motions that another scene may endanger first, then jobs to
  // whose start arms are to be brought (whether they could run from there), arms that could open a
  // ring, jobs whose turn it is, arms that could go aside. Whether jobs have been put off on the
  // way: then who waits for whom is another. `turns`: as they are.
  [[nodiscard]] bool ask_next(State& state, const Turns& turns, const WaitCycles& cycles);
  // The answer to the open question. One on an older version is void and asked again.
  void on(const Judged& input, State& state, WaitCycles& cycles);

 private:
  enum class Purpose {
    start,    // of a job that waits
    option,   // the same, of one of several that could take a turn
    itself,   // of a job alone, from where it begins, though its arms are elsewhere
    recheck,  // of a motion that is under way or scheduled
    yield,    // whether an arm could go aside, and the job then pass
  };
  struct OpenQuestion {
    Version version;
    std::vector<JobId> jobs;
    Purpose purpose;
    std::optional<YieldTrial> yield = {};
    std::vector<Passage> passages = {};  // Question::passages
    bool is_only_option = false;         // nothing else could take the turn
  };
  // Policies that admit groups: everything that waits is tried as one; if that fails, these alone.
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

#pragma once

#include <optional>
#include <vector>

#include "core/jobs/transitions.h"
#include "core/scheduler/waiting/choosing.h"
#include "core/scheduler/waiting/turns.h"
#include "core/scheduler/waiting/wait_cycles.h"
#include "core/scheduler/yielding/yield_moves.h"

namespace armloom {

// Asks geometry one question at a time and handles the answer: admits jobs with passing orders,
// asks a further question, or lets jobs wait. A job is admitted together with its orders, in one
// step.
class Admission {
 public:
  // Asks the next question if none is open. `turns` must be current. Returns true if jobs were
  // deferred or replanned meanwhile: the waits have then changed. The first of these questions is
  // asked:
  // - Is a motion still free after a change of the scene?
  // - Is a job that is to be moved to its start feasible from there?
  // - Can an arm retreat to open a deadlock cycle?
  // - Can the job whose turn it is be admitted?
  // - Can an idle arm retreat?
  [[nodiscard]] bool ask_next(Transitions& state, const Turns& turns, const WaitCycles& cycles);
  // Handles the answer to the open question. If the version has changed since, the answer is void
  // and the question is asked again.
  void on(const Judged& input, Transitions& state, WaitCycles& cycles);

 private:
  enum class Purpose {
    start,    // can this waiting job be admitted?
    option,   // the same, for one of several options (waiting/options.h)
    itself,   // is a job free by itself from its start, although its arms are elsewhere?
    recheck,  // is an admitted motion still free?
    yield,    // can an arm retreat, and does the job then pass?
  };
  struct OpenQuestion {
    Version version;
    std::vector<StepId> steps;
    Purpose purpose;
    std::optional<YieldTrial> yield = {};
    std::vector<Passage> passages = {};  // Question::passages
    bool is_only_option = false;         // no other option could take the turn
  };
  // For policies that admit groups: all waiting steps are tried as one group. If that fails, only
  // the steps of `alone` are tried.
  struct Together {
    Version version;
    std::vector<StepId> alone;
  };

  void ask(Transitions& state, std::vector<StepId> steps, SafeSequence::Outlook outlook,
           Purpose purpose = Purpose::start);
  void ask_about(Transitions& state, StepId step, Question question, Purpose purpose);
  void ask_yield(Transitions& state, YieldTrial move);
  void answer_yield(Transitions& state, const Verdict& verdict, YieldTrial move,
                    WaitCycles& cycles);
  void answer_option(Transitions& state, Verdict verdict);
  void answer_start(Transitions& state, const Verdict& verdict, const std::vector<StepId>& steps);
  void decide(Transitions& state, const Verdict& verdict, const std::vector<StepId>& steps);
  [[nodiscard]] bool leaves_a_sequence(Transitions& state, const std::vector<StepId>& steps);
  [[nodiscard]] bool tries_together(Transitions& state, const std::vector<StepId>& steps,
                                    bool can_go);

  std::optional<OpenQuestion> open_;
  Choosing choosing_;
  std::optional<Together> together_;
};

}  // namespace armloom

#pragma once

#include <cstddef>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/transitions.h"

namespace armloom {

// An option for a turn. It is one of:
// - the job whose turn it is
// - a later job of its arm with the same priority, start and end, if both are reorderable
//   (JobTerms::reorderable)
// - the job on another arm (Submit::alternatives)
// Options of a job without a goal leave every arm where it was, so all other jobs remain possible.
struct Option {
  JobId job;
  std::size_t alternative = 0;  // index into Step::alternatives, if there are any
  bool goes_now = true;         // false if other jobs of that arm must go first

  bool operator==(const Option&) const = default;
};

// Largest number of options among the jobs of one arm.
inline constexpr std::size_t kOptionsMax = 6;
// Largest number of jobs with an undecided arm that are considered before they are the first of an
// arm.
inline constexpr std::size_t kUndecidedMax = 16;
[[nodiscard]] std::vector<JobId> first_undecided(const State& state);

// Returns the options for the turn, the default first. A job that was first overtaken longer than
// scheduling.aging ago is not overtaken again.
[[nodiscard]] std::vector<Option> options_of(const State& state, JobId turn);
// Returns true if another job of the same arm could take this job's turn.
[[nodiscard]] bool others_may_take_its_turn(const State& state, const Step& turn);
// Returns true if the job is queued and it is its turn on the arm of one of its alternatives.
[[nodiscard]] bool has_turn_on_some_arm(const State& state, const Step& step);

// Returns the place of this waiting job in the arm's queue: behind the last job that is admitted or
// has an earlier turn. A job of the server has the turn of the job that it helps.
[[nodiscard]] std::size_t place_on(const State& state, const Step& step, ArmId arm);
// Gives the job this alternative, and moves it to place_on() in the queue of that arm.
void take_alternative(Transitions& state, const Step& step, std::size_t which);

// Call before the steps `go` are admitted. Some undecided jobs might then no longer be possible on
// the arm that they have. Assigns each of these to another arm for good, and returns true if there
// was one.
[[nodiscard]] bool take_arms_that_remain(Transitions& state, const std::vector<StepId>& go);

// Assigns one job of the cycle for good to another arm that can do it. Returns false if there is no
// such job.
[[nodiscard]] bool leaves_by_other_arm(Transitions& state, const WaitCycle& ring);

// Gives the turn to the option with index `first`. The other jobs follow in their previous order.
void give_turn(Transitions& state, const std::vector<Option>& options, std::size_t first);
// Call after a job was added. If the new job could take the turn of a deferred job, that job is
// checked again.
void reopen_turn(Transitions& state, const Step& added);
// Returns true if all options still wait.
[[nodiscard]] bool stand(const State& state, const std::vector<Option>& options);
// Gives the queued job an alternative that begins where its arm is, or will be at the job's turn.
// Returns false if there is none.
[[nodiscard]] bool begins_on_other_arm(Transitions& state, const Step& step);

}  // namespace armloom

#pragma once

#include <cstddef>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"

namespace armloom {

// An option for a turn: the job whose turn it is; a later job of its arm with equal priority, start
// and end, if both are reorderable (JobTerms::reorderable); or the job on another arm
// (Submit::alternatives). All options leave every arm where it was, so all other jobs remain
// possible.
struct Option {
  JobId job;
  std::size_t alternative = 0;  // index into Job::alternatives, if there are any
  bool goes_now = true;         // false if other jobs of that arm precede it

  bool operator==(const Option&) const = default;
};

// Largest number of options among the jobs of one arm.
inline constexpr std::size_t kOptionsMax = 6;
// Number of undecided jobs that are considered although other jobs precede them.
inline constexpr std::size_t kUndecidedMax = 16;
[[nodiscard]] std::vector<JobId> first_undecided(const State& state);

// Returns the options, the default first. A job that was overtaken for scheduling.aging is not
// overtaken again.
[[nodiscard]] std::vector<Option> options_of(State& state, JobId turn);
// Returns true if another job of its arm could take the job's turn.
[[nodiscard]] bool others_may_take_its_turn(const State& state, const Record& turn);
// Returns true if the job is queued, has alternatives, and has its turn on the arm of one of them.
[[nodiscard]] bool has_turn_on_some_arm(const State& state, const Record& record);

// Returns the number of jobs in the arm's queue up to the last one that precedes this waiting job:
// an admitted job, one with an earlier turn, or a server-initiated job for such a job.
[[nodiscard]] std::size_t place_on(const State& state, const Record& record, ArmId arm);
// Gives the job this alternative, at place_on() in the queue of its arm.
void take_alternative(State& state, Record& record, std::size_t which);

// Before `go` are admitted: assigns each job that could then be done by one other arm only, because
// its own arm would be blocked, to that arm for good. Returns true if there were any.
[[nodiscard]] bool take_arms_that_remain(State& state, const std::vector<JobId>& go);

// Assigns a job of the cycle to another arm that can do it. Returns true if there was any.
[[nodiscard]] bool leaves_by_other_arm(State& state, const WaitCycle& ring);

// Makes the order permanent: option `first` goes first, then the others as they were.
void give_turn(State& state, const std::vector<Option>& options, std::size_t first);
// After a new job: lets the job that it could replace be checked again, if that was deferred.
void reopen_turn(State& state, const Record& added);
// Returns true if all options still wait.
[[nodiscard]] bool stand(const State& state, const std::vector<Option>& options);
// Gives the job an alternative whose arm rests at its start. Returns false if there is none.
[[nodiscard]] bool begins_on_other_arm(State& state, Record& record);

}  // namespace armloom

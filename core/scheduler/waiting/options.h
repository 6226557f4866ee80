#pragma once

#include <cstddef>
#include <vector>

#include "core/deadlock/waits_for.h"
#include "core/jobs/state.h"

namespace armloom {

// What could take a turn: the job whose turn it is; one of those that follow it on its arm and like
// it may be reordered (JobTerms::reorderable), have its priority, and begin and end where it
// does; or the job on another arm (Submit::alternatives). None of these leaves an arm elsewhere, so
// that everything else remains as possible as it was.
struct Option {
  JobId job;
  std::size_t alternative = 0;  // index into Job::alternatives, where there are such
  bool goes_now = true;         // else others of that arm come before it

  bool operator==(const Option&) const = default;
};

// So many jobs of a lane are looked at for one turn.
inline constexpr std::size_t kOptionsMax = 6;
// Of jobs that other arms could do the first so many are looked at, though others come before them.
inline constexpr std::size_t kUndecidedMax = 16;
[[nodiscard]] std::vector<JobId> first_undecided(const State& state);

// The first one is how things are. Who has been overtaken for scheduling.aging is overtaken no
// more.
[[nodiscard]] std::vector<Option> options_of(State& state, JobId turn);
// There is another job of its arm that could go in its place.
[[nodiscard]] bool others_may_take_its_turn(const State& state, const Record& turn);
// It waits, has alternatives, and its turn has come on the arm of one of them.
[[nodiscard]] bool has_turn_on_some_arm(const State& state, const Record& record);

// So many of the arm's jobs come before this one, which waits: that are admitted, or came before
// it, and what goes before these.
[[nodiscard]] std::size_t place_on(const State& state, const Record& record, ArmId arm);
// From now on it is the job's to go by this alternative, behind those.
void take_alternative(State& state, Record& record, std::size_t which);

// Before these go: jobs that could come to their ends on another arm only, as others rest in their
// way on the one that they have, are that one's for good from now on. Whether there were any.
[[nodiscard]] bool take_arms_that_remain(State& state, const std::vector<JobId>& go);

// A job of a ring that another arm could do is that one's for good. Whether there was any.
[[nodiscard]] bool leaves_by_other_arm(State& state, const WaitCycle& ring);

// From now on this is how things are: that one first, then the others as they were.
void give_turn(State& state, const std::vector<Option>& options, std::size_t first);
// A job came: where it could take the turn of one that was put off, that is judged again.
void reopen_turn(State& state, const Record& added);
// All of them still wait.
[[nodiscard]] bool stand(const State& state, const std::vector<Option>& options);
// It does not begin where its arm stands: it is done by an arm that stands where it can, if there
// is one.
[[nodiscard]] bool begins_on_other_arm(State& state, Record& record);

}  // namespace armloom

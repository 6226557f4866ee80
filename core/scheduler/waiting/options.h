#pragma once

#include <cstddef>
#include <vector>

#include "core/scheduler/state.h"

namespace armloom {

// What could take a turn: the job whose turn it is; another one of its arm that has the same
// priority and begins and ends where it does (Submit::any_order); or the job on another arm
// (Submit::alternatives).
struct Option {
  JobId job;
  std::size_t alternative = 0;  // index into Job::alternatives, where there are such
  bool goes_now = true;         // else others of that arm come before it

  bool operator==(const Option&) const = default;
};

// So many jobs of a lane are looked at for one turn.
inline constexpr std::size_t kOptionsMax = 6;

// The first one is how things are. Who has been overtaken for scheduling.aging is overtaken no
// more.
[[nodiscard]] std::vector<Option> options_of(State& state, JobId turn);
// Of a job that waits and has alternatives: whether its turn has come on the arm of one of them.
[[nodiscard]] bool has_turn_on_some_arm(const State& state, const Record& record);

// From now on this is how things are; `holder` has the turn, and gives it away.
void give_turn(State& state, JobId holder, const Option& option);
// It does not begin where its arm stands: it is done by an arm that stands where it can, if there
// is one.
[[nodiscard]] bool begins_on_other_arm(State& state, Record& record);

}  // namespace armloom

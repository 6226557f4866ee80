#pragma once

#include <cstddef>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Groups of steps that are tried together, because some of them cannot be admitted alone or would
// block others.

// Largest number of waiting steps in a group, to bound the decision time.
inline constexpr std::size_t kTogetherMax = 16;

// Returns the group plus the first steps of every arm that are neither admitted nor in the group,
// each after its predecessors. Leaves out steps that cannot go (for example because they are
// stopped or their jobs name unfinished jobs in `after`), and all steps behind them.
[[nodiscard]] std::vector<StepId> with_all_that_wait(const State& state,
                                                     const std::vector<StepId>& group);
// Returns the group plus the next step of each of these arms, if that step could go too. The group
// is unchanged if there is no such step, or if the policy admits no groups.
[[nodiscard]] std::vector<StepId> with_next_jobs(const State& state, std::vector<StepId> group,
                                                 const std::vector<ArmId>& in_the_way);

// Returns true if each step begins where its arms will be: at the end of an admitted motion or of
// an earlier step of the group, or where they rest now. If not, conflict regions would not cover
// the place where an arm rests between two motions.
[[nodiscard]] bool follow_each_other(const State& state, const std::vector<StepId>& steps);

}  // namespace armloom

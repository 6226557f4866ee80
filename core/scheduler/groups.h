#pragma once

#include <cstddef>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Groups of jobs that are tried together, because some of them cannot be admitted alone or would
// block others.

// Largest number of waiting jobs in a group, to bound the decision time.
inline constexpr std::size_t kTogetherMax = 16;

// Returns the group plus the first jobs of every arm that are neither admitted nor in the group,
// each after its predecessors. Leaves out jobs that cannot go (for example because they are stopped
// or name unfinished jobs in `after`), and all jobs behind them.
[[nodiscard]] std::vector<JobId> with_all_that_wait(const State& state,
                                                    const std::vector<JobId>& group);
// Returns the group plus the next job of each of these arms, if that job could go too. The group is
// unchanged if there is no such job, or if the policy admits no groups.
[[nodiscard]] std::vector<JobId> with_next_jobs(const State& state, std::vector<JobId> group,
                                                const std::vector<ArmId>& in_the_way);

// Returns true if each job begins where its arms will be: at the end of an admitted motion or of an
// earlier job of the group, or where they rest now. If not, conflict regions would not cover the
// place where an arm rests between two motions.
[[nodiscard]] bool follow_each_other(const State& state, const std::vector<JobId>& jobs);

}  // namespace armloom

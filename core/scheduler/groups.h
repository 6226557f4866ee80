#pragma once

#include <cstddef>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Groups of jobs that are tried together because some cannot be admitted alone, or not without
// harm.

// Largest number of waiting jobs in a group, to bound the decision time.
inline constexpr std::size_t kTogetherMax = 16;

// Returns the group plus the first jobs of every arm that are neither admitted nor in it, each
// after its predecessors; without jobs that wait for others or are stopped, and without the jobs
// behind those.
[[nodiscard]] std::vector<JobId> with_all_that_wait(const State& state,
                                                    const std::vector<JobId>& group);
// Returns the group plus the next job of each of these arms, if that job could go too. Returns the
// group itself if there is none or the policy admits no groups.
[[nodiscard]] std::vector<JobId> with_next_jobs(const State& state, std::vector<JobId> group,
                                                const std::vector<ArmId>& in_the_way);

// Returns true if each job begins where its arms will be: at the end of admitted motions, of an
// earlier job of the group, or at their present rest. Otherwise the rest between two motions has no
// regions.
[[nodiscard]] bool follow_each_other(const State& state, const std::vector<JobId>& jobs);

}  // namespace armloom

#pragma once

#include <cstddef>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Which jobs are tried together with some that cannot go alone, or not without harm.

// So many jobs that wait are tried as one at most, lest a decision take long.
inline constexpr std::size_t kTogetherMax = 16;

// With the first jobs of every arm that are neither admitted nor in the group; each after those
// before it; without what comes after other jobs or is stopped, and without what is behind that.
[[nodiscard]] std::vector<JobId> with_all_that_wait(const State& state,
                                                    const std::vector<JobId>& group);
// With the first such job of each of these arms, if that could go too. The same group: there is
// none, or the policy admits no groups.
[[nodiscard]] std::vector<JobId> with_next_jobs(const State& state, std::vector<JobId> group,
                                                const std::vector<ArmId>& in_the_way);

// Returns true if each of these begins where its arms will stand: at the end of what is admitted
// before it, of one of them that is named before it, or where they rest now. What is admitted
// otherwise has no regions for the rest between two motions.
[[nodiscard]] bool follow_each_other(const State& state, const std::vector<JobId>& jobs);

}  // namespace armloom

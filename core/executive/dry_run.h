#pragma once

#include <string>
#include <vector>

#include "core/executive/simulation.h"

namespace armloom {

struct CheckedJob {
  std::string key;  // the client's, or "job-<n>" for the n-th job
  CheckView verdict;
};

// Judges jobs against each other without running them, by the admission's own code. Each is taken
// to begin at its time, or when the jobs of its arms that stand before it and those that it comes
// `after` have run to their ends; it is judged at that instant beside every other job that has
// begun by then (of those that begin together: that stands before it), whatever the verdict on that
// one was. So of each two that overlap the later one is judged against the earlier one.
// Where the policy coordinates, a job that could not go for arms in its way is judged together with
// their next jobs. `earliest_start_s` counts from the job's own time. In the order given.
//
// Problems: an unknown policy; arms too close at home, as in a cell that cannot be served; what
// submit() would say, its pointers below "/<index>/job".
[[nodiscard]] Result<std::vector<CheckedJob>> check_jobs(CellPtr cell, const std::string& policy,
                                                         const std::vector<TimedJob>& jobs);

}  // namespace armloom

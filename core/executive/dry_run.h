#pragma once

#include <string>
#include <vector>

#include "core/executive/simulation.h"

namespace armloom {

struct CheckedJob {
  std::string key;  // the client's, or "job-<n>" for the n-th job
  CheckView verdict;
};

// Judges jobs against each other without running them. Each is taken to begin at its time, or when
// the jobs of its arms that stand before it and those that it comes `after` have run to their ends.
// What is said of it is what the scheduler would do with it in that instant (Trial) beside every
// other job that has begun by then (of those that begin together: that stands before it), whatever
// the verdict on that one was, and before the next jobs of the other arms. So of each two that
// overlap the later one is judged against the earlier one. `earliest_start_s` counts from the job's
// own time. In the order given.
//
// Problems: an unknown policy; arms too close at home, as in a cell that cannot be served; what
// submit() would say, its pointers below "/<index>/job".
// A goal (`move_to`) is planned from where the jobs before it leave all arms; of several arms the
// one that would arrive first without the others has it. Where there is no plan it is told by the
// verdict's result, as of what comes after it.
[[nodiscard]] Result<std::vector<CheckedJob>> check_jobs(CellPtr cell, const std::string& policy,
                                                         const std::vector<TimedJob>& jobs);

}  // namespace armloom

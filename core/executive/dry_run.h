#pragma once

#include <string>
#include <vector>

#include "core/executive/simulation.h"

namespace armloom {

struct CheckedJob {
  std::string key;  // the client's, or "job-<n>" for the n-th job
  CheckView verdict;
};

// Checks jobs against each other without running them, and returns the results in the given order.
// A job is assumed to start at its own time, or when the earlier jobs of its arms and the jobs in
// its `after` have ended. It is checked at that time (Trial) against all jobs that have started by
// then, whatever their verdict; among jobs with equal start times, against those listed earlier. So
// of two overlapping jobs the later one is checked against the earlier one. `earliest_start_s` is
// relative to the job's own time.
//
// A goal (`move_to`) is planned from where the earlier jobs leave all arms. Of several candidate
// arms, the one that would arrive first on its own is taken. If there is no plan, the verdict's
// `result` says so, and so do the verdicts of jobs that depend on it.
//
// Problems: an unknown policy; arms too close at home; those of submit(), with pointers below
// "/<index>/job".
[[nodiscard]] Result<std::vector<CheckedJob>> check_jobs(CellPtr cell, const std::string& policy,
                                                         const std::vector<TimedJob>& jobs);

}  // namespace armloom

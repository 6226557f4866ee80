#pragma once

#include <string>
#include <vector>

#include "core/executive/simulation.h"

namespace armloom {

struct CheckedJob {
  std::string key;  // the client's, or "job-<n>" for the n-th job
  CheckView verdict;
};

// Checks jobs against each other without running them; results are in the given order. A job is
// assumed to start at its time, or when the earlier jobs of its arms and those in `after` have
// ended. It is checked then (Trial) against all jobs that have started, whatever their verdict, and
// among equal start times against those listed earlier. `earliest_start_s` is relative to the job's
// own time.
//
// A goal (`move_to`) is planned from where the earlier jobs leave all arms; of several arms the
// first to arrive takes it. Without a plan, its verdict and those of dependent jobs have a
// `result`.
//
// Problems: an unknown policy; arms too close at home; those of submit(), with pointers below
// "/<index>/job".
[[nodiscard]] Result<std::vector<CheckedJob>> check_jobs(CellPtr cell, const std::string& policy,
                                                         const std::vector<TimedJob>& jobs);

}  // namespace armloom

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
// assumed to start at its time, or later when the earlier jobs of its arms and the jobs in `after`
// have ended. It is checked at its start (Trial) against all jobs that have started by then,
// whatever their verdict. Among jobs with the same start, the job listed first starts first.
// `earliest_start_s` is relative to the job's own time.
//
// The path to a goal (`move_to`) is planned from where the earlier jobs leave all arms. Of several
// candidate arms, the arm that arrives first takes the job. If there is no plan, the verdicts of
// this job and of the jobs that name it in `after` have a `result`.
//
// Each motion of a job with steps is checked like a job that begins when the steps before it are
// done, in the scene of that time: with what all arms then hold. Waits for inputs take no time. The
// verdict is that of the first motion that is not free (CheckView::step).
//
// Problems: an unknown policy; arms that are too close at home; the problems of
// Executive::submit(), with pointers below "/<index>/job".
[[nodiscard]] Result<std::vector<CheckedJob>> check_jobs(CellPtr cell, const std::string& policy,
                                                         const std::vector<TimedJob>& jobs);

}  // namespace armloom

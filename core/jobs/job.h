#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/jobs/job_terms.h"

namespace armloom {

// The purpose of a server-initiated job.
struct Errand {
  JobId on_behalf_of{0};  // the client job that this job helps; a client's job helps itself
  std::optional<JobId> before = {};     // the job of the same arm that this job must precede
  std::optional<JobId> lets_pass = {};  // this job does not begin while that job waits
};

// The facts that the steps of a job share.
struct Job {
  JobId id;
  JobTerms terms = {};
  std::vector<JobId> after = {};  // jobs of Submit::after that have not ended yet
  bool system_job = false;        // as in Submit
  bool is_held_over = false;
  bool awaits_record = false;      // StartRecorded
  std::optional<JobId> task = {};  // as in Submit
  bool awaits_actions = false;     // ActionsDone
  int retries = 0;                 // left; as in Submit
  JobId turn;                      // rank among jobs: the job's own id, unless jobs were reordered
  Errand errand;
  TimePoint submitted_at{};
  // The deadlock cycle that contains the job, this job first; empty if there is none. Each job
  // waits for the next one, and the last for the first. Not cleared if the job fails because of it.
  std::vector<JobId> ring = {};
};

// Returns the only step of the job.
[[nodiscard]] constexpr StepId only_step(JobId job) { return StepId{job, 0}; }

}  // namespace armloom

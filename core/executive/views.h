#pragma once

#include <string>

#include "core/executive/events.h"
#include "core/jobs/job.h"
#include "core/model/cell.h"
#include "core/scheduler/trial.h"

namespace armloom {

// What clients call their jobs, the string beside the JobId, and whom they are for.
class JobNames {
 public:
  virtual ~JobNames() = default;
  [[nodiscard]] virtual std::string key(JobId job) const = 0;
  [[nodiscard]] virtual std::string name(JobId job) const = 0;
  // Whether a job that has not ended moves the arm, or will.
  [[nodiscard]] virtual bool has_job(ArmId arm) const = 0;
  // Whether the arm stays where it is until it is resumed.
  [[nodiscard]] virtual bool is_stopped(ArmId arm) const = 0;
};

// What a job waits for; in_vain: it has given up waiting.
[[nodiscard]] WaitView view_of(const Wait& wait, const Cell& cell, const JobNames& names,
                               bool in_vain = false);

// The scheduler's job with names instead of ids.
[[nodiscard]] JobView view_of(const Job& job, const Cell& cell, const JobNames& names);

// What would become of a job, but for the version of the scene.
[[nodiscard]] CheckView view_of(const Trial::Outcome& outcome, const Cell& cell,
                                const JobNames& names);

}  // namespace armloom

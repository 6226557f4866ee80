#pragma once

#include <cstddef>
#include <string>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/jobs/step.h"
#include "core/model/cell.h"
#include "core/scheduler/trial.h"

namespace armloom {

// Source of the clients' names of jobs, by JobId, and of the state of arms; used to make views.
class JobNames {
 public:
  virtual ~JobNames() = default;
  [[nodiscard]] virtual std::string key(JobId job) const = 0;
  [[nodiscard]] virtual std::string name(JobId job) const = 0;
  // Returns true if an active job moves the arm, or will.
  [[nodiscard]] virtual bool has_job(ArmId arm) const = 0;
  // Returns true if the arm is stopped until it is resumed.
  [[nodiscard]] virtual bool is_stopped(ArmId arm) const = 0;
};

// Returns the view of a wait, with a remedy as detail. `in_vain`: the job has ended, so the detail
// says what would have helped.
[[nodiscard]] WaitView view_of(const Wait& wait, const Cell& cell, const JobNames& names,
                               bool in_vain = false);

// Returns the scheduler's job with names instead of ids.
[[nodiscard]] JobView view_of(const Step& step, const Cell& cell, const JobNames& names);

// Returns the view of a check's outcome, without the scene version.
[[nodiscard]] CheckView view_of(const Trial::Outcome& outcome, const Cell& cell,
                                const JobNames& names);
// Adds the verdict on a motion of a task to the verdict on the motions before it, which are free.
// `step`: the index of the motion.
void add_step(CheckView& all, CheckView one, std::size_t step, bool is_first);
// Returns the verdict on a step that cannot be done.
[[nodiscard]] CheckView failed_step(const Problems& problems);

}  // namespace armloom

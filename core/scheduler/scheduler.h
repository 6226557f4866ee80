#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "core/scheduler/inputs.h"
#include "core/scheduler/job.h"
#include "core/scheduler/policy.h"

namespace armloom {

// The pure heart: queue, backlog, reservations, order per arm, stops. A deterministic state machine
// without threads, clock, sockets or geometry. Admission and reservation are one step: a job that
// is judged free holds its reservation before step() returns, and no other judgement is open.
//
// A reservation is: a job that is scheduled, running, or braking (its remaining motion); every
// other arm occupies the place where it rests. A job in `holding` at rest is such a rest.
class Scheduler {
 public:
  // `rest` is where every joint stands at the beginning. The policy is not null.
  Scheduler(CellPtr cell, std::unique_ptr<const Policy> policy, Configuration rest);
  ~Scheduler();

  // Time never goes backwards (throws std::invalid_argument). An input that names an unknown or
  // ended job is ignored. Effects are to be carried out in order.
  [[nodiscard]] std::vector<Effect> step(const Input& input, TimePoint now);

  // Where `arm` will stand when all jobs accepted for it have succeeded (its joints' positions in
  // a whole-cell configuration): a new job for the arm has to begin there.
  [[nodiscard]] Configuration predicted_rest() const;

  [[nodiscard]] const Policy& policy() const { return *policy_; }
  [[nodiscard]] const Job* find(JobId job) const;  // null: unknown or forgotten
  [[nodiscard]] std::vector<JobId> active() const;  // all not ended, in order of submission
  [[nodiscard]] bool stopped(ArmId arm) const;
  // Ended jobs are kept until forgotten, so that the caller can read how they ended.
  void forget(JobId ended);

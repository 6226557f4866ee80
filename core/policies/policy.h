#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "core/base/problem.h"
#include "core/coordination/motion.h"
#include "core/jobs/state.h"
#include "core/model/cell.h"
#include "core/policies/policy_names.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// A rule for sharing the workspace. Pure. A new policy needs one file in core/policies, its name in
// policy_names.h and a case in make_policy().
class Policy {
 public:
  virtual ~Policy() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;

  // Returns how geometry checks candidates.
  [[nodiscard]] virtual CheckMethod method() const = 0;
  // Decides the passing orders between candidates and admitted motions, or returns the blockers.
  [[nodiscard]] virtual PassingOrders decide(const OrderQuestion& question) const = 0;

  // For policies with rounds: returns the jobs of the present round. state.round is the previous
  // round.
  [[nodiscard]] virtual Round next_round(const State& /*state*/) const { return {}; }
  // For policies that limit how many jobs run at once: returns a job that must end before the
  // waiting `job` is checked; nullopt if there is none.
  [[nodiscard]] virtual std::optional<JobId> place_taken_by(const State& /*state*/,
                                                            const Step& /*job*/) const {
    return std::nullopt;
  }
  // True if another job gets a place although none is free, when all jobs that have a place wait
  // for jobs without a place.
  [[nodiscard]] virtual bool opens_places() const { return false; }
  // True if an aged job holds other jobs back (scheduler/README.md, Aging).
  [[nodiscard]] virtual bool lets_jobs_age() const { return true; }
  // Largest number of jobs per arm that are admitted together, including the running one.
  [[nodiscard]] virtual std::size_t horizon() const { return 1; }
  // True if passing orders are chosen again when motions deviate from the prediction.
  [[nodiscard]] virtual bool weighs_again() const { return false; }
  // True if a job that cannot be admitted alone is tried together with other waiting jobs.
  [[nodiscard]] virtual bool admits_groups() const { return false; }
};

// Returns the named policy with the cell's settings. Problem (invalid, "unknown-policy"): the name
// is not in policy_names().
[[nodiscard]] Result<std::unique_ptr<const Policy>> make_policy(std::string_view name,
                                                                const Cell& cell);

}  // namespace armloom

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

// What distinguishes one way of sharing the workspace from another. Pure. A new policy is one file
// in core/policies, its name in policy_names.h and a case in make_policy().
class Policy {
 public:
  virtual ~Policy() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;

  // What geometry is asked of candidates.
  [[nodiscard]] virtual CheckMethod method() const = 0;
  // Who passes first where candidates meet what is admitted, or what stands against it.
  [[nodiscard]] virtual PassingOrders decide(const OrderQuestion& question) const = 0;

  // Policies with rounds: the jobs of the present one, which state.round holds as it was.
  [[nodiscard]] virtual Round next_round(const State& /*state*/) const { return {}; }
  // The job that this one, which waits, has to wait for before it is judged; or nothing.
  [[nodiscard]] virtual std::optional<JobId> place_taken_by(const State& /*state*/,
                                                            const Record& /*job*/) const {
    return std::nullopt;
  }
  // True if a place opens as soon as those that have one only wait for those that have none.
  [[nodiscard]] virtual bool opens_places() const { return false; }
  // Whether a job that has waited for long holds others back.
  [[nodiscard]] virtual bool lets_jobs_age() const { return true; }
  // Of each lane so many legs are admitted at most, the one under way included.
  [[nodiscard]] virtual std::size_t horizon() const { return 1; }
  // Whether orders are chosen anew when something comes otherwise than expected.
  [[nodiscard]] virtual bool weighs_again() const { return false; }
  // Whether a job that cannot go alone is tried together with others that wait.
  [[nodiscard]] virtual bool admits_groups() const { return false; }
};

// The policies by name, with the cell's settings. Problem (invalid, "unknown-policy"): the name is
// none of policy_names().
[[nodiscard]] Result<std::unique_ptr<const Policy>> make_policy(std::string_view name,
                                                                const Cell& cell);

}  // namespace armloom

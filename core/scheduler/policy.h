#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/motion.h"
#include "core/model/cell.h"
#include "core/scheduler/job.h"
#include "core/scheduler/passing_orders.h"

namespace armloom {

// What distinguishes one way of sharing the workspace from another. Pure. A new policy is one file
// in core/scheduler/policies and one line in make_policy().
class Policy {
 public:
  virtual ~Policy() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;

  // Whether one more job may be judged beside the jobs that are scheduled, running or holding
  // (`occupying`, in order of submission). The job that it has to wait for, or nullopt.
  [[nodiscard]] virtual std::optional<JobId> capacity_taken_by(
      const std::vector<const Job*>& /*occupying*/) const {
    return std::nullopt;
  }

  // What geometry is asked of candidates.
  [[nodiscard]] virtual CheckMethod method() const = 0;
  // Who passes first where candidates meet what is admitted, or what stands against it.
  [[nodiscard]] virtual PassingOrders decide(const OrderQuestion& question) const = 0;
  // Whether jobs go in rounds: one of each arm, and the next when all of these have ended.
  [[nodiscard]] virtual bool in_rounds() const { return false; }
  // Whether a job that cannot go alone is tried together with others that wait.
  [[nodiscard]] virtual bool admits_groups() const { return false; }
};

// The policies by name, with the cell's settings. Problem (invalid, "unknown-policy"): the name is
// none of policy_names().
[[nodiscard]] Result<std::unique_ptr<const Policy>> make_policy(std::string_view name,
                                                                const Cell& cell);
[[nodiscard]] std::vector<std::string> policy_names();

}  // namespace armloom

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
      const std::vector<const Job*>& occupying) const = 0;

  // How candidates are compared with everything else.
  [[nodiscard]] virtual CheckMethod method() const = 0;
  // Whether a job that cannot start now is given the earliest start that is free.
  [[nodiscard]] virtual bool schedules_ahead() const { return false; }
  // Whether jobs go in rounds: one of each arm, and the next when all of these have ended.
  [[nodiscard]] virtual bool in_rounds() const { return false; }
  // Whether motions go beside each other by the order in which they pass, held by authority over
  // their progress (precedence_graph.h), instead of by times. method() is Coordinated then.
  [[nodiscard]] virtual bool coordinates() const { return false; }
  // How a motion is compared that is under way and was admitted by method().
  [[nodiscard]] virtual CheckMethod recheck_method() const { return method(); }
};

// The policies by name, with the cell's settings. Problem (invalid, "unknown-policy"): the name is
// none of policy_names().
[[nodiscard]] Result<std::unique_ptr<const Policy>> make_policy(std::string_view name,
                                                                const Cell& cell);
[[nodiscard]] std::vector<std::string> policy_names();

}  // namespace armloom

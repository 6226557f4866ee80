#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <variant>

#include "core/base/problem.h"
#include "core/coordination/motion.h"
#include "core/model/cell.h"
#include "core/policies/policy_names.h"
#include "core/precedence/passing_orders.h"

namespace armloom {

// How many jobs may run at the same time (core/scheduler/waiting/capacity.h).
enum class Capacity {
  any,
  one_job,  // in the whole cell
  rounds,   // one job per arm; the next round begins when all have ended
};

struct Lookahead {
  // Largest number of jobs per arm that are admitted together, including the running one.
  std::size_t horizon = 1;
  // A job that cannot be admitted alone is tried together with other waiting jobs.
  bool admits_groups = false;
  // Passing orders are chosen again when motions deviate from the prediction.
  bool weighs_again = false;
};

// A rule for sharing the workspace. A new policy needs its name in policy_names.h and its values in
// policy.cc.
struct Policy {
  std::string_view name;
  CheckMethod method;  // how geometry checks candidates
  // Decides the passing orders between candidates and admitted motions, or returns the blockers.
  // Pure.
  PassingOrders (*decide)(const OrderQuestion& question);
  Capacity capacity = Capacity::any;
  Lookahead lookahead = {};

  // False under TimedDiscrete: without passing orders and certificates, nothing is promised between
  // its time steps.
  [[nodiscard]] bool has_orders() const { return !std::holds_alternative<TimedDiscrete>(method); }
};

// Returns the named policy with the cell's settings. Problem (invalid, "unknown-policy"): the name
// is not in policy_names().
[[nodiscard]] Result<std::unique_ptr<const Policy>> make_policy(std::string_view name,
                                                                const Cell& cell);

}  // namespace armloom

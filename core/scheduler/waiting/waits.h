#pragma once

#include "core/coordination/verdict.h"
#include "core/scheduler/job.h"
#include "core/scheduler/orders/passing_orders.h"
#include "core/scheduler/orders/precedence_graph.h"

namespace armloom {

// What a job waits for because of a conflict, of an order that cannot be had, or of one that holds
// it.
[[nodiscard]] Wait wait_for(const Conflict& conflict);
[[nodiscard]] Wait wait_for(const Obstacle& obstacle);
[[nodiscard]] Wait wait_for(const HeldBack& held);

}  // namespace armloom

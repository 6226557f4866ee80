#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/conflict_region.h"
#include "core/coordination/verdict.h"
#include "core/precedence/coordinated_motion.h"
#include "core/precedence/precedence.h"
#include "core/precedence/prediction.h"

namespace armloom {

// The reason why a motion is not admitted or, if admitted, cannot go on.
struct Blocker {
  JobId blocked;
  std::optional<JobId> other;  // the motion that passes first, or that it cannot pass ...
  std::optional<ArmId> arm;    // ... or the arm at rest in its path
  Proximity proximity;         // evidence; body_a belongs to `blocked`
  Duration own_time;
  Duration other_time;
};

// The question of which motion passes first in the regions between candidates and admitted motions.
struct OrderQuestion {
  const std::vector<CoordinatedMotion>& admitted;
  const std::vector<Precedence>& precedences;  // between the admitted motions
  const std::vector<CoordinatedMotion>& candidates;
  const std::vector<PairRegions>& regions;
  const std::vector<Duration>& work_behind;  // by ArmId: of jobs in neither list
};

// The passing order in every region, or the blockers.
struct PassingOrders {
  std::vector<Precedence> precedences;  // all, if admitted; existing orders included
  Prediction prediction;                // of the admitted motions, then the candidates
  std::vector<Blocker> blockers;        // of candidates; empty if admitted
  std::vector<ArmId> in_the_way;  // arms that end or rest in a path and whose next motion might
                                  // clear it; ascending
};

// Returns the orders with the least cost with which all motions reach their ends (order_search.h).
// Reverses existing orders if that helps.
[[nodiscard]] PassingOrders cheapest_orders(const OrderQuestion& question);

// Returns orders by the clock for one candidate: its earliest start, at most `latest` from now,
// with which it passes each region before or after the predicted admitted motion, without a stop.
// From then on the orders apply, not the times: it begins when the motions that it lets pass have
// progressed as predicted. Existing orders are kept.
[[nodiscard]] PassingOrders orders_in_time(const OrderQuestion& question,
                                           std::optional<Duration> latest);

// Returns no orders: admits candidates only if they have no conflict region.
[[nodiscard]] PassingOrders orders_apart(const OrderQuestion& question);

}  // namespace armloom

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

// The reason why a motion is not admitted, or why an admitted motion cannot go on.
struct Blocker {
  StepId blocked;
  std::optional<StepId> other;  // the motion that passes first, or that `blocked` cannot pass ...
  std::optional<ArmId> arm;     // ... or the arm at rest in its path
  Proximity proximity;          // evidence; body_a belongs to `blocked`
  Duration own_time;
  Duration other_time;
};

// The question: which motion passes first in each region of candidates and admitted motions?
struct OrderQuestion {
  const std::vector<CoordinatedMotion>& admitted;
  const std::vector<Precedence>& precedences;  // between the admitted motions
  HeldAt held_at;                              // of the admitted motions
  const std::vector<CoordinatedMotion>& candidates;
  const std::vector<PairRegions>& regions;
  const std::vector<Duration>& work_behind;  // by ArmId: duration of the jobs in neither list
};

// The answer to an OrderQuestion: the passing order in every region, or the blockers.
struct PassingOrders {
  std::vector<Precedence> precedences;  // all, if admitted; existing orders included
  Prediction prediction;                // of the admitted motions, then the candidates
  std::vector<Blocker> blockers;        // of candidates; empty if admitted
  // Arms that rest, or would end, in another motion's path, which their next motion might clear;
  // ascending.
  std::vector<ArmId> in_the_way;
};

// Returns the cheapest orders with which all motions reach their ends (order_search.h). Reverses
// existing orders if that reduces the cost.
[[nodiscard]] PassingOrders cheapest_orders(const OrderQuestion& question);

// Returns orders for one candidate, found by the clock. They follow from its earliest start, at
// most `latest` from now, at which it passes each region before or after the predicted admitted
// motion without a stop. From then on the orders apply, not the times: the candidate begins when
// the motions that pass first have progressed as predicted. Existing orders are kept.
[[nodiscard]] PassingOrders orders_in_time(const OrderQuestion& question,
                                           std::optional<Duration> latest);

// Admits the candidates, without orders, only if they have no conflict region.
[[nodiscard]] PassingOrders orders_apart(const OrderQuestion& question);

}  // namespace armloom

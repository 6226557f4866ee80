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

// What keeps a motion from being admitted, or, where it is, from going on.
struct Blocker {
  JobId blocked;
  std::optional<JobId> other;  // the motion that passes first, or that it cannot pass ...
  std::optional<ArmId> arm;    // ... or the arm that rests in its way
  Proximity proximity;         // evidence; body_a is the blocked one's
  Duration own_time;
  Duration other_time;
};

// Who is to pass first in the candidates' regions, beside what is admitted?
struct OrderQuestion {
  const std::vector<CoordinatedMotion>& admitted;
  const std::vector<Precedence>& precedences;  // between these
  const std::vector<CoordinatedMotion>& candidates;
  const std::vector<PairRegions>& regions;
  const std::vector<Duration>& work_behind;  // by ArmId: of jobs that are in neither list
};

// The answer: who passes first in every region, or what stands against it.
struct PassingOrders {
  std::vector<Precedence> precedences;  // of every region, if admitted; those of before included
  Prediction prediction;                // of the admitted motions, then the candidates
  std::vector<Blocker> blockers;        // of candidates; empty: admitted
  std::vector<ArmId> in_the_way;  // arms that end or rest in the way: a next motion of theirs might
                                  // open it; ascending
};

// The orders under which everything comes to its end that cost least (order_search.h). Orders of
// before are turned where that helps.
[[nodiscard]] PassingOrders cheapest_orders(const OrderQuestion& question);

// Of one candidate: the orders in which all go on by the clock. What is admitted is predicted; the
// candidate begins so much later than now that it passes each region before or after the other
// without a stop on its way; it is the least such time, and no more than `latest` where given. From
// then on the orders count, not the times: it begins when those it lets pass are as far as they
// were to be then. Orders of before stay.
[[nodiscard]] PassingOrders orders_in_time(const OrderQuestion& question,
                                           std::optional<Duration> latest);

// None: the candidates go beside what meets them nowhere.
[[nodiscard]] PassingOrders orders_apart(const OrderQuestion& question);

}  // namespace armloom

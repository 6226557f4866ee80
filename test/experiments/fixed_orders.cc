#include "test/experiments/fixed_orders.h"

namespace armloom::experiments {
namespace {

// Marks all motions as not to be overtaken, so that decided orders stay. The place of a new motion
// is chosen as before.
PassingOrders keep_orders(const OrderQuestion& question) {
  const auto keep = [](std::vector<CoordinatedMotion> motions) {
    for (CoordinatedMotion& motion : motions) motion.outlook.keeps_its_place = true;
    return motions;
  };
  const auto admitted = keep(question.admitted), candidates = keep(question.candidates);
  return cheapest_orders({admitted, question.precedences, question.held_at, candidates,
                          question.regions, question.work_behind});
}

}  // namespace

std::shared_ptr<const Policy> make_fixed_orders(const Cell& cell) {
  Policy policy = *make_policy("coordinated", cell).value();
  policy.name = kFixedOrders;
  policy.decide = keep_orders;
  policy.lookahead.weighs_again = false;
  return std::make_shared<Policy>(std::move(policy));
}

}  // namespace armloom::experiments

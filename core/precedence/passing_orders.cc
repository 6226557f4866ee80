#include "core/precedence/passing_orders.h"

#include <utility>

#include "core/precedence/open_orders.h"
#include "core/precedence/order_search.h"

namespace armloom {
PassingOrders cheapest_orders(const OrderQuestion& question) {
  OpenOrders open(question);
  if (open.blocked()) return open.refused({});
  Prediction best = OrderSearch(open, question.work_behind).run();
  return best.stuck.empty() ? open.admitted(std::move(best)) : open.stuck(best);
}

PassingOrders orders_apart(const OrderQuestion& question) {
  OpenOrders open(question);
  std::vector<std::size_t> met;
  for (std::size_t d = open.decided(); d < open.orders().size(); ++d) met.push_back(d);
  if (open.blocked() || !met.empty()) return open.refused(met);
  return open.admitted(open.predicted());
}

}  // namespace armloom

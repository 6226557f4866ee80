#pragma once

#include <cstddef>
#include <vector>

#include "core/precedence/open_orders.h"

namespace armloom {

// For each order, the orders that are decided together with it: one region ends at an arm's rest,
// the other begins there, and the same other motion passes both.
class OrderTies {
 public:
  OrderTies(const std::vector<OpenOrder>& orders, const std::vector<CoordinatedMotion>& motions,
            const MotionChains& chains);

  [[nodiscard]] const std::vector<OrderChoice::Member>& of(std::size_t order) const {
    return of_[order];
  }

 private:
  void tie(std::size_t d, std::size_t e, const std::vector<OpenOrder>& orders,
           const std::vector<CoordinatedMotion>& motions, const MotionChains& chains);

  std::vector<std::vector<OrderChoice::Member>> of_;
};

}  // namespace armloom

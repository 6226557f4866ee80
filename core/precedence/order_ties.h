#pragma once

#include <cstddef>
#include <vector>

#include "core/precedence/open_orders.h"

namespace armloom {

// For each order, the orders that must be decided together with it. Two orders are tied if an arm
// rests between two of its motions, one region ends at this rest, the other begins there, and the
// same motion of another arm passes both regions.
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

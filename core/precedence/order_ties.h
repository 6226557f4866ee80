#pragma once

#include <cstddef>
#include <vector>

#include "core/precedence/open_orders.h"

namespace armloom {

// Of each order, those that are decided with it: where one region ends at a rest of an arm and
// another one begins there, in the way of the same other motion.
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

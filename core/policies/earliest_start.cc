// The certified rule, and instead of waiting for its blocker's end a job is given the earliest
// start with which it passes all running and scheduled motions without a stop. Its orders then
// hold: nothing that comes after it can put it off, and it begins when those before it are far
// enough.
#include "core/policies/policies.h"

namespace armloom {
namespace {

class EarliestStartPolicy final : public Policy {
 public:
  explicit EarliestStartPolicy(const Cell& cell) : tracking_errors_(cell) {}

  std::string_view name() const override { return "earliest_start"; }
  CheckMethod method() const override { return Coordinated{tracking_errors_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_in_time(question, std::nullopt);
  }

 private:
  TrackingErrors tracking_errors_;
};

}  // namespace

std::unique_ptr<const Policy> make_earliest_start(const Cell& cell) {
  return std::make_unique<EarliestStartPolicy>(cell);
}

}  // namespace armloom

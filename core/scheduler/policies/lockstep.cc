// Synchronous execution, the baseline of the paper's experiments: rounds of one job for each arm.
// They start together; those in conflict within a round follow one after the other. The next round
// begins when all have ended.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class LockstepPolicy final : public Policy {
 public:
  explicit LockstepPolicy(double tracking_error) : tracking_error_(tracking_error) {}

  std::string_view name() const override { return "lockstep"; }
  bool in_rounds() const override { return true; }
  CheckMethod method() const override { return Coordinated{tracking_error_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_in_time(question, Duration{});
  }

 private:
  double tracking_error_;
};

}  // namespace

std::unique_ptr<const Policy> make_lockstep(const Cell& cell) {
  return std::make_unique<LockstepPolicy>(cell.checking.tracking_error_rad);
}

}  // namespace armloom

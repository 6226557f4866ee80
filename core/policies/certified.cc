// The paper's rule, answered for every instant and with proof: a job starts beside the running ones
// when by the clock it passes each of their conflict regions before or after them without a stop.
// Then that is the order, however late anybody is. Else it goes to the backlog and is tried again
// when what is admitted has changed.
#include "core/policies/policies.h"

namespace armloom {
namespace {

class CertifiedPolicy final : public Policy {
 public:
  explicit CertifiedPolicy(const Cell& cell) : tracking_errors_(cell) {}

  std::string_view name() const override { return "certified"; }
  CheckMethod method() const override { return Coordinated{tracking_errors_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_in_time(question, Duration{});
  }

 private:
  TrackingErrors tracking_errors_;
};

}  // namespace

std::unique_ptr<const Policy> make_certified(const Cell& cell) {
  return std::make_unique<CertifiedPolicy>(cell);
}

}  // namespace armloom

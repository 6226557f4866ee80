// The paper's rule, answered for every instant and with proof: a job starts beside the running ones
// when nothing comes closer than the cell's clearance, though each motion may lag behind its plan
// by checking.delay_s, leave its path by checking.tracking_error_rad, and have to stop at any time.
// Else it goes to the backlog and is tried again when what holds reservations has changed.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class CertifiedPolicy final : public Policy {
 public:
  explicit CertifiedPolicy(double tracking_error) : tracking_error_(tracking_error) {}

  std::string_view name() const override { return "certified"; }
  CheckMethod method() const override { return Coordinated{tracking_error_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_in_time(question, Duration{});
  }

 private:
  double tracking_error_;
};

}  // namespace

std::unique_ptr<const Policy> make_certified(const Cell& cell) {
  return std::make_unique<CertifiedPolicy>(cell.checking.tracking_error_rad);
}

}  // namespace armloom

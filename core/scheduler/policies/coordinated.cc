// Motions share the workspace by passing orders instead of clocks: a job starts as soon as there is
// an order in which everything comes to its end, goes as far as its precedences let it, pauses
// there on its path, and goes on when the others have passed. Any arm may be late, slow or stop.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class CoordinatedPolicy final : public Policy {
 public:
  explicit CoordinatedPolicy(double tracking_error) : tracking_error_(tracking_error) {}

  std::string_view name() const override { return "coordinated"; }
  bool admits_groups() const override { return true; }
  CheckMethod method() const override { return Coordinated{tracking_error_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return cheapest_orders(question);
  }

 private:
  double tracking_error_;
};

}  // namespace

std::unique_ptr<const Policy> make_coordinated(const Cell& cell) {
  return std::make_unique<CoordinatedPolicy>(cell.checking.tracking_error_rad);
}

}  // namespace armloom

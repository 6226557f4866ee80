// Motions share the workspace by passing orders instead of clocks: a job starts as soon as there is
// an order in which everything comes to its end, goes as far as its precedences let it, pauses
// there on its path, and goes on when the others have passed. Any arm may be late, slow or stop.
// The next legs of every lane are admitted ahead, so that the orders of all of them are chosen
// together.
#include "core/policies/policies.h"

namespace armloom {
namespace {

class CoordinatedPolicy final : public Policy {
 public:
  explicit CoordinatedPolicy(const Cell& cell)
      : tracking_errors_(cell), horizon_(static_cast<std::size_t>(cell.scheduling.horizon_steps)) {}

  std::string_view name() const override { return "coordinated"; }
  std::size_t horizon() const override { return horizon_; }
  bool weighs_again() const override { return true; }
  bool admits_groups() const override { return true; }
  CheckMethod method() const override { return Coordinated{tracking_errors_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return cheapest_orders(question);
  }

 private:
  TrackingErrors tracking_errors_;
  std::size_t horizon_;
};

}  // namespace

std::unique_ptr<const Policy> make_coordinated(const Cell& cell) {
  return std::make_unique<CoordinatedPolicy>(cell);
}

}  // namespace armloom

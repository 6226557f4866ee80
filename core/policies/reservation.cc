// A motion reserves everything that it sweeps for as long as it runs: a job starts when no place of
// its way is too close to any place of what remains of the others' ways (Meehan et al.). Times do
// not count, so that any motion may be late.
#include "core/policies/policies.h"

namespace armloom {
namespace {

class ReservationPolicy final : public Policy {
 public:
  explicit ReservationPolicy(const Cell& cell) : tracking_errors_(cell) {}

  std::string_view name() const override { return "reservation"; }
  CheckMethod method() const override { return Swept{tracking_errors_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_apart(question);
  }

 private:
  TrackingErrors tracking_errors_;
};

}  // namespace

std::unique_ptr<const Policy> make_reservation(const Cell& cell) {
  return std::make_unique<ReservationPolicy>(cell);
}

}  // namespace armloom

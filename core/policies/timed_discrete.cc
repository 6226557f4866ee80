// The paper's policy: a job starts beside the running ones when both, compared at equal instants
// every time_step, keep their clearance; else it goes to the backlog and is tried again when what
// holds reservations has changed. Between the instants nothing is promised.
#include "core/policies/policies.h"

namespace armloom {
namespace {

class TimedDiscretePolicy final : public Policy {
 public:
  explicit TimedDiscretePolicy(Duration time_step) : time_step_(time_step) {}

  std::string_view name() const override { return "timed_discrete"; }
  CheckMethod method() const override { return TimedDiscrete{time_step_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_apart(question);
  }

 private:
  Duration time_step_;
};

}  // namespace

std::unique_ptr<const Policy> make_timed_discrete(const Cell& cell) {
  return std::make_unique<TimedDiscretePolicy>(cell.checking.time_step);
}

}  // namespace armloom

// One job at a time in the whole cell, as MoveIt executes. What stands in the way at rest (other
// arms, the scene) is still judged.
#include "core/policies/policies.h"

namespace armloom {
namespace {

class SequentialPolicy final : public Policy {
 public:
  explicit SequentialPolicy(const Cell& cell) : tracking_errors_(cell) {}

  std::string_view name() const override { return "sequential"; }
  std::optional<JobId> place_taken_by(const State& state, const Step& step) const override {
    std::vector<const Step*> others = occupying(state.jobs);
    std::erase(others, &step);  // held on its path
    return others.empty() ? std::nullopt : std::optional(others.front()->id.job);
  }
  CheckMethod method() const override { return Coordinated{tracking_errors_}; }
  PassingOrders decide(const OrderQuestion& question) const override {
    return orders_apart(question);
  }

 private:
  TrackingErrors tracking_errors_;
};

}  // namespace

std::unique_ptr<const Policy> make_sequential(const Cell& cell) {
  return std::make_unique<SequentialPolicy>(cell);
}

}  // namespace armloom

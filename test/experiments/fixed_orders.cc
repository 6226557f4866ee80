#include "test/experiments/fixed_orders.h"

namespace armloom::experiments {
namespace {

class FixedOrders final : public Policy {
 public:
  explicit FixedOrders(std::unique_ptr<const Policy> coordinated)
      : coordinated_(std::move(coordinated)) {}

  std::string_view name() const override { return kFixedOrders; }
  std::size_t horizon() const override { return coordinated_->horizon(); }
  bool admits_groups() const override { return coordinated_->admits_groups(); }
  CheckMethod method() const override { return coordinated_->method(); }
  // Marks all motions as not to be overtaken, so that decided orders stay. The place of a new
  // motion is chosen as before.
  PassingOrders decide(const OrderQuestion& question) const override {
    const auto keep = [](std::vector<CoordinatedMotion> motions) {
      for (CoordinatedMotion& motion : motions) motion.outlook.keeps_its_place = true;
      return motions;
    };
    const auto admitted = keep(question.admitted), candidates = keep(question.candidates);
    return coordinated_->decide({admitted, question.precedences, question.held_at, candidates,
                                 question.regions, question.work_behind});
  }

 private:
  std::unique_ptr<const Policy> coordinated_;
};

}  // namespace

std::shared_ptr<const Policy> make_fixed_orders(const Cell& cell) {
  return std::make_shared<FixedOrders>(make_policy("coordinated", cell).value());
}

}  // namespace armloom::experiments

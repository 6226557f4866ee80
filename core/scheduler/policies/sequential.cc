// One job at a time in the whole cell, as MoveIt executes. What stands in the way at rest (other
// arms, the scene) is still judged.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class Sequential final : public Policy {
 public:
  explicit Sequential(const CheckingSettings& checking) : checking_(checking) {}

  std::string_view name() const override { return "sequential"; }

  std::optional<JobId> capacity_taken_by(const std::vector<const Job*>& occupying) const override {
    if (occupying.empty()) return std::nullopt;
    return occupying.front()->id;
  }

  CheckMethod method() const override { return certified(checking_); }
  CheckMethod recheck_method() const override { return certified_under_way(checking_); }

 private:
  CheckingSettings checking_;
};

}  // namespace

std::unique_ptr<const Policy> make_sequential(const Cell& cell) {
  return std::make_unique<Sequential>(cell.checking);
}

}  // namespace armloom

// Synchronous execution, the baseline of the paper's experiments: rounds of one job for each arm.
// They start together; those in conflict within a round follow one after the other. The next round
// begins when all have ended.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class LockstepPolicy final : public Policy {
 public:
  explicit LockstepPolicy(const CheckingSettings& checking) : checking_(checking) {}

  std::string_view name() const override { return "lockstep"; }

  std::optional<JobId> capacity_taken_by(const std::vector<const Job*>&) const override {
    return std::nullopt;
  }

  CheckMethod method() const override { return certified(checking_); }
  CheckMethod recheck_method() const override { return certified_under_way(checking_); }
  bool in_rounds() const override { return true; }

 private:
  CheckingSettings checking_;
};

}  // namespace

std::unique_ptr<const Policy> make_lockstep(const Cell& cell) {
  return std::make_unique<LockstepPolicy>(cell.checking);
}

}  // namespace armloom

// The certified rule, and instead of waiting for its blocker's end a job is given the earliest
// start that is free beside all running and scheduled motions. It then counts in every later
// judgement, so that nothing that comes after it can put it off.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class EarliestStartPolicy final : public Policy {
 public:
  explicit EarliestStartPolicy(const CheckingSettings& checking) : checking_(checking) {}

  std::string_view name() const override { return "earliest_start"; }

  std::optional<JobId> capacity_taken_by(const std::vector<const Job*>&) const override {
    return std::nullopt;
  }

  CheckMethod method() const override { return certified(checking_); }
  CheckMethod recheck_method() const override { return certified_under_way(checking_); }
  bool schedules_ahead() const override { return true; }

 private:
  CheckingSettings checking_;
};

}  // namespace

std::unique_ptr<const Policy> make_earliest_start(const Cell& cell) {
  return std::make_unique<EarliestStartPolicy>(cell.checking);
}

}  // namespace armloom

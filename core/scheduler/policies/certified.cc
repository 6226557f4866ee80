// The paper's rule, answered for every instant and with proof: a job starts beside the running ones
// when nothing comes closer than the cell's clearance, though each motion may lag behind its plan
// by checking.delay_s, leave its path by checking.tracking_error_rad, and have to stop at any time.
// Else it goes to the backlog and is tried again when what holds reservations has changed.
#include "core/scheduler/policies/policies.h"

namespace armloom {
namespace {

class CertifiedPolicy final : public Policy {
 public:
  explicit CertifiedPolicy(const CheckingSettings& checking) : checking_(checking) {}

  std::string_view name() const override { return "certified"; }

  std::optional<JobId> capacity_taken_by(const std::vector<const Job*>&) const override {
    return std::nullopt;
  }

  CheckMethod method() const override { return certified(checking_); }
  CheckMethod recheck_method() const override { return certified_under_way(checking_); }

 private:
  CheckingSettings checking_;
};

}  // namespace

CheckMethod certified(const CheckingSettings& checking) {
  return Certified{checking.delay, true, checking.tracking_error_rad};
}

// What was admitted may meanwhile have used up its band of delay: without it, a motion that keeps
// to its plan asks for less than it was granted.
CheckMethod certified_under_way(const CheckingSettings& checking) {
  return Certified{Duration{}, true, checking.tracking_error_rad};
}

std::unique_ptr<const Policy> make_certified(const Cell& cell) {
  return std::make_unique<CertifiedPolicy>(cell.checking);
}

}  // namespace armloom

#pragma once

#include <vector>

#include "core/executive/shown.h"
#include "core/executive/status_board.h"

namespace armloom {

// The views of arms for clients.
class ArmReports {
 public:
  explicit ArmReports(const Shown& shown);

  // Updates present().
  void look();
  [[nodiscard]] const std::vector<ArmStatus>& present() const { return present_; }  // by ArmId
  // Returns the present views that differ from those of the last call.
  [[nodiscard]] std::vector<ArmView> take_changed();
  [[nodiscard]] std::vector<ArmView> views() const;
  [[nodiscard]] std::vector<ArmAuthority> authorities() const;
  [[nodiscard]] bool all_stopped() const;

 private:
  [[nodiscard]] bool is_told_of_a_start(ArmId arm) const;
  [[nodiscard]] std::optional<JobId> job_of(ArmId arm) const;
  [[nodiscard]] ArmState state_of(ArmId arm) const;
  [[nodiscard]] ArmStatus status_of(ArmId arm) const;
  [[nodiscard]] ArmView view_of_arm(ArmId arm, const ArmStatus& status) const;

  Shown shown_;
  std::vector<ArmStatus> present_;  // by ArmId, ...
  std::vector<ArmStatus> told_;     // ... and in the last take_changed()
};

}  // namespace armloom

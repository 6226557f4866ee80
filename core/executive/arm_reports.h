#pragma once

#include <vector>

#include "core/executive/job_register.h"
#include "core/executive/motions.h"
#include "core/executive/start_gate.h"
#include "core/executive/status_board.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// The views of arms for clients.
class ArmReports {
 public:
  // The objects of which it tells; all outlive it.
  struct Of {
    const Cell& cell;
    const Scheduler& scheduler;
    const Motions& motions;
    const JobRegister& jobs;
    const StartGate& starts;
  };
  explicit ArmReports(const Of& of);

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
  [[nodiscard]] ArmState state_of(ArmId arm) const;
  [[nodiscard]] ArmStatus status_of(ArmId arm) const;
  [[nodiscard]] ArmView view_of_arm(ArmId arm, const ArmStatus& status) const;

  Of of_;
  std::vector<ArmStatus> present_;  // by ArmId, ...
  std::vector<ArmStatus> told_;     // ... and in the last take_changed()
};

}  // namespace armloom

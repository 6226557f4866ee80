#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "core/arm/arm_controller.h"
#include "core/arm/arm_fault.h"

namespace armloom {

// A controller with faults, for tests and simulation. It stands between the caller and the inner
// controller, on the controller's side of the contract. Deterministic.
class FaultyArm final : public ArmController, public FaultTarget {
 public:
  // Moves the inner controller's first joint off its path by this distance (rad, m).
  using Push = std::function<void(double)>;
  // Without `push`, the arm cannot drift.
  explicit FaultyArm(std::unique_ptr<ArmController> inner, Push push = {});

  void inject(std::uint64_t id, ArmFault fault) override;
  bool remove(std::uint64_t id) override;

  [[nodiscard]] const std::vector<JointId>& joints() const override { return inner_->joints(); }
  void send(const ArmCommand& command) override;
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override;
  [[nodiscard]] const Eigen::VectorXd* true_positions() const override {
    return inner_->true_positions();
  }

 private:
  using Phase = ArmFeedback::Phase;

  [[nodiscard]] const ArmFault* active(ArmFault::Kind kind) const;
  void carry_out(const ArmCommand::Follow& follow);
  void carry_out(const ArmCommand::Extend& extend);
  void carry_out(const ArmCommand::Release& release);
  void carry_out(const ArmCommand::Brake& brake);
  template <class Command>
  void carry_out(const Command& command) {
    pass_on(command);
  }
  template <class Command>
  void pass_on(const Command& command) {
    inner_->send({++inner_number_, command});
  }
  void act(Duration period);
  void withhold(Duration period);
  void give_up();
  void report(const ArmFeedback& inner);
  [[nodiscard]] bool fault_changes() const;
  [[nodiscard]] bool may_drift() const;

  std::unique_ptr<ArmController> inner_;
  std::map<std::uint64_t, ArmFault> faults_;
  TimePoint now_{};
  CommandNumber acknowledged_ = 0;  // of the caller's commands
  CommandNumber inner_number_ = 0;  // of the last command to the inner controller
  // The caller's and the inner controller's number of the last follow.
  std::pair<CommandNumber, CommandNumber> follow_{};
  bool under_way_ = false;
  Duration granted_{};  // authority granted by the caller
  Duration allowed_{};  // authority passed on to the inner controller
  // During a `slow` fault: authority (s) that it grants, growing with time.
  std::optional<double> creep_s_;
  bool giving_up_ = false;
  Push push_;
  bool is_braked_ = false;  // since the last follow
  ArmFeedback feedback_;
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/arm/arm_controller.h"
#include "core/arm/arm_fault.h"
#include "core/arm/gaussian_noise.h"
#include "core/arm/simulated_arm.h"

namespace armloom {

// A simulated arm with faults, on the controller's side of the contract. All kinds of ArmFault but
// those of the link; they can be combined. Deterministic.
class FaultyArm final : public ArmController, public FaultTarget {
 public:
  // `seed`: of the fault `noise`.
  explicit FaultyArm(std::unique_ptr<SimulatedArm> inner, std::uint64_t seed = 1);

  void inject(std::uint64_t id, ArmFault fault) override;
  bool remove(std::uint64_t id) override;
  [[nodiscard]] std::map<std::uint64_t, ArmFault> faults() const override { return faults_.all(); }

  [[nodiscard]] const std::vector<JointId>& joints() const override { return inner_->joints(); }
  void send(const ArmCommand& command) override;
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override;
  [[nodiscard]] const Eigen::VectorXd* true_positions() const override {
    return inner_->true_positions();
  }

  // The connection to the caller is lost: the controller brakes by itself.
  void lose_connection();
  // Forgets the motion and the numbers of commands, as a controller does that is started again.
  // Returns false, and forgets nothing, while the arm moves.
  [[nodiscard]] bool restart();

 private:
  using Phase = ArmFeedback::Phase;
  using Kind = ArmFault::Kind;

  [[nodiscard]] const ArmFault* active(Kind kind) const { return faults_.active(kind, now_); }
  void carry_out(const ArmCommand::Follow& follow);
  void carry_out(const ArmCommand::Extend& extend);
  void carry_out(const ArmCommand::Brake& brake);
  void carry_out(const ArmCommand::Release& release);
  void carry_out(const ArmCommand::SetSpeed& speed) { pass_on(speed); }
  template <class Command>
  void pass_on(const Command& command) {
    inner_->send({++inner_number_, command});
  }
  void forget_motion();
  void act(Duration period);
  void limit(Duration period);
  void give_up();
  void report(const ArmFeedback& inner);
  [[nodiscard]] bool report_changes() const;

  std::unique_ptr<SimulatedArm> inner_;
  FaultList faults_;
  GaussianNoise noise_;
  TimePoint now_{};
  CommandNumber acknowledged_ = 0;  // of the caller's commands
  CommandNumber inner_number_ = 0;  // of the last command to the inner controller

  // The present motion.
  struct Motion {
    // The caller's and the inner controller's number of the follow command.
    std::pair<CommandNumber, CommandNumber> follow{};
    bool under_way = false;
    bool rejected = false;   // by the fault `reject`
    bool ran_away = false;   // was allowed more than the caller's authority
    bool giving_up = false;  // brakes, and will report a fault
    bool braked = false;
    Duration end{};      // of the trajectory
    Duration granted{};  // authority granted by the caller
    Duration allowed{};  // authority passed on to the inner controller
    // During a `slow` fault: authority (s) that it grants, growing with time.
    std::optional<double> creep_s = {};
    std::optional<ArmCommand::Brake> ignored = {};  // a brake that is carried out later
  };
  Motion motion_;
  ArmFeedback feedback_;
  std::optional<ArmFeedback> frozen_;
};

}  // namespace armloom

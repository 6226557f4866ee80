#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <random>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/arm/arm_fault.h"
#include "core/arm/faulty_arm.h"

namespace armloom {

// The link to a simulated controller, with faults (is_of_link). Passes faults of the arm on to it.
// Stands between ArmLink and the arm. Faults can be combined. Deterministic.
//
// Without faults, messages arrive at once. Faults that delay a message keep the order of messages,
// except `reorder`.
class FaultyLink final : public ArmController, public FaultTarget {
 public:
  // A message that is overtaken by others is late by this time.
  inline static constexpr Duration kOvertaken = std::chrono::milliseconds(5);

  FaultyLink(std::unique_ptr<FaultyArm> arm, std::uint64_t seed);

  void inject(std::uint64_t id, ArmFault fault) override;
  bool remove(std::uint64_t id) override;
  [[nodiscard]] std::map<std::uint64_t, ArmFault> faults() const override;

  [[nodiscard]] const std::vector<JointId>& joints() const override { return arm_->joints(); }
  void send(const ArmCommand& command) override;
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override;
  [[nodiscard]] ArmConnection connection() const override { return connection_; }
  [[nodiscard]] const Eigen::VectorXd* true_positions() const override {
    return arm_->true_positions();
  }

 private:
  using Kind = ArmFault::Kind;
  template <class Message>
  struct Way {
    struct UnderWay {
      TimePoint arrives;
      Message message;
    };
    std::deque<UnderWay> messages;  // by time of arrival
    TimePoint last{};               // arrival of the last message that keeps the order
  };

  [[nodiscard]] const ArmFault* active(Kind kind) const { return faults_.active(kind, now_); }
  [[nodiscard]] bool chance(Kind kind);
  [[nodiscard]] double uniform();
  template <class Message>
  void put(Way<Message>& way, const Message& message);
  void deliver_commands();
  void take_reports();
  void connect_or_cut();
  [[nodiscard]] bool is_plain() const;

  std::unique_ptr<FaultyArm> arm_;
  FaultList faults_;
  std::mt19937_64 random_;
  TimePoint now_{};
  ArmConnection connection_;
  bool restarting_ = false;
  Duration clock_ahead_{};            // of the controller's clock, compared with cell time
  std::uint64_t last_sequence_ = 0;   // of the arm's reports
  std::uint64_t before_restart_ = 0;  // the same, at the last restart of the controller
  Way<ArmCommand> commands_;
  Way<ArmFeedback> reports_;
  ArmFeedback delivered_;
};

}  // namespace armloom

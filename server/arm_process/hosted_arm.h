#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/arm/arm_controller.h"
#include "core/model/cell.h"
#include "server/drivers/arm_messages.h"

namespace armloom {

// One arm of the process that controls a robot: numbers the server's commands, and brakes the arm
// by itself when the server is gone.
class HostedArm {
 public:
  HostedArm(CellPtr cell, ArmId arm, std::unique_ptr<ArmController> controller);

  [[nodiscard]] const std::string& name() const { return cell_->arm(arm_).name; }
  // Begins to count the commands of another server. The motion of the previous one is dropped, as
  // soon as the arm rests.
  void begin_session();
  // Brakes on the path (category 2).
  void brake();

  // Carries out a command of the server unless its number is not the next. `start_at` is on the
  // clock of the simulation.
  void follow(const Numbered<FollowMessage>& command, TimePoint start_at);
  void obey(CommandNumber number, decltype(ArmCommand::what) what);

  // Runs one control cycle. Returns a report for the server, or null.
  [[nodiscard]] const ArmFeedback* tick(TimePoint now);
  [[nodiscard]] bool is_at_rest() const { return feedback_.at_rest; }

 private:
  void pass_on(decltype(ArmCommand::what) what);
  void reject(CommandNumber number, std::string why);
  [[nodiscard]] Result<TrajectoryPtr> trajectory_of(const FollowMessage& follow) const;

  CellPtr cell_;
  ArmId arm_;
  std::unique_ptr<ArmController> controller_;
  CommandNumber acknowledged_ = 0;  // of the server's commands
  CommandNumber inner_ = 0;         // of the controller's commands: the server's and own ones
  std::deque<std::pair<CommandNumber, CommandNumber>> passed_;  // inner number, server's number
  // The last rejected command; the motion that it would have begun counts as a fault.
  CommandNumber rejected_ = 0;
  std::string why_rejected_;
  bool is_motion_refused_ = false;
  bool drops_motion_ = false;
  ArmFeedback feedback_;
};

}  // namespace armloom

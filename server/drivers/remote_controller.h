#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/arm/make_controller.h"
#include "server/drivers/remote_robot.h"

namespace armloom {

// The controller of an arm of a robot in another process.
class RemoteController final : public ArmController {
 public:
  // `arm`: index in Robot::arms.
  RemoteController(std::shared_ptr<RemoteRobot> robot, const Cell& cell, ArmId id);

  [[nodiscard]] const std::vector<JointId>& joints() const override { return joints_; }
  // A command is written to a connection once; sockets do not lose what they deliver.
  void send(const ArmCommand& command) override;
  [[nodiscard]] const ArmFeedback* poll(TimePoint now) override;
  [[nodiscard]] ArmConnection connection() const override { return connection_; }

 private:
  std::shared_ptr<RemoteRobot> robot_;
  std::size_t arm_;
  std::vector<JointId> joints_;
  ArmConnection connection_;
  CommandNumber sent_ = 0;  // the last, over this connection
  ArmFeedback feedback_;
};

// Returns the type "remote". Arms of one robot share its connection. `session`: see Hello.
[[nodiscard]] ControllerTypes remote_controllers(std::string session);

// Returns the names of the cell's robots that are controlled by another process.
[[nodiscard]] std::vector<std::string> remote_robots(const Cell& cell);

}  // namespace armloom

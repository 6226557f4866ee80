#include "server/drivers/remote_controller.h"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

namespace armloom {

RemoteController::RemoteController(std::shared_ptr<RemoteRobot> robot, const Cell& cell, ArmId id)
    : robot_(std::move(robot)), joints_(cell.arm(id).joints) {
  const Arm& arm = cell.arm(id);
  const std::vector<ArmId>& arms = cell.robots[arm.robot.index()].arms;
  arm_ = static_cast<std::size_t>(std::ranges::find(arms, id) - arms.begin());
  joints_.insert(joints_.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
  connection_ = {false, "no answer yet from " + cell.robots[arm.robot.index()].controller.endpoint,
                 0};
}

void RemoteController::send(const ArmCommand& command) {
  if (!connection_.is_up || command.number <= sent_) return;
  sent_ = command.number;
  robot_->send(connection_.number, arm_, command);
}

const ArmFeedback* RemoteController::poll(TimePoint now) {
  robot_->cycle(now);
  auto event = robot_->next(arm_);
  if (!event) return nullptr;
  if (auto* connection = std::get_if<ArmConnection>(&*event)) {
    // The caller must see the change before the first report that follows.
    if (connection->number != connection_.number) sent_ = 0;
    connection_ = std::move(*connection);
    return nullptr;
  }
  feedback_ = std::move(std::get<ArmFeedback>(*event));
  return &feedback_;
}

ControllerTypes remote_controllers(std::string session) {
  struct Robots {
    std::string session;
    std::map<RobotId, std::weak_ptr<RemoteRobot>> known;
  };
  const auto robots = std::make_shared<Robots>();
  robots->session = std::move(session);
  const auto make = [robots](const CellPtr& cell, ArmId arm, const Eigen::VectorXd&,
                             std::uint64_t) -> Result<MadeController> {
    const RobotId id = cell->arm(arm).robot;
    std::shared_ptr<RemoteRobot> robot = robots->known[id].lock();
    if (!robot) {
      robot = std::make_shared<RemoteRobot>(cell, id, robots->session);
      robots->known[id] = robot;
    }
    return MadeController{std::make_unique<RemoteController>(std::move(robot), *cell, arm)};
  };
  return {{"remote", make}};
}

std::vector<std::string> remote_robots(const Cell& cell) {
  std::vector<std::string> names;
  for (const Robot& robot : cell.robots) {
    if (robot.controller.type == "remote") names.push_back(robot.name);
  }
  return names;
}

}  // namespace armloom

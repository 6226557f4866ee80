#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/arm/simulated_arm.h"
#include "core/base/problem.h"
#include "core/model/cell.h"
#include "server/log/log_line.h"
#include "server/physics/plant.h"

namespace armloom {

// A robot whose arms are simulated by MuJoCo. A SimulatedArm moves the reference of each arm along
// its path; the drives of the plant follow the reference. Reports carry the measured positions of
// the plant. Measured progress is the progress, at most that of the reference, at which the path is
// closest to the measured positions; it never falls during a motion. An arm has come to rest when
// the plant has. The next motion starts where the plant is, if its drives were off.
class PhysicsRobot {
 public:
  // `payload`: unknown to the drives. Problems: those of Plant::create(). `log` gets the plant's
  // assumptions, and each pair of bodies that touches for the first time.
  [[nodiscard]] static Result<std::shared_ptr<PhysicsRobot>> create(CellPtr cell, RobotId robot,
                                                                    std::optional<Payload> payload,
                                                                    Log log);
  // Returns the controllers of the robot's arms, in the order of Robot::arms. They share `robot`.
  [[nodiscard]] static std::vector<std::unique_ptr<ArmController>> controllers(
      const std::shared_ptr<PhysicsRobot>& robot);

 private:
  class Arm;
  struct Simulated {
    Simulated(const CellPtr& cell, ArmId id);

    ArmId id;
    SimulatedArm reference;
    std::vector<Eigen::Index> rows;    // of its joints in the plant
    ArmFeedback feedback;              // as reported
    std::optional<ArmCommand> follow;  // the last
    TrajectoryPtr trajectory;          // of the present motion
    bool has_drives = true;
    Duration unsettled{};  // since the reference came to rest
  };

  PhysicsRobot(CellPtr cell, RobotId robot, Plant plant, Log log);
  void send(Simulated& arm, const ArmCommand& command);
  void advance(TimePoint now);
  void report(Simulated& arm, const ArmFeedback& reference, Duration period);
  void move_with_plant(Simulated& arm);
  void tell_contacts();
  [[nodiscard]] bool rests(const Simulated& arm) const;

  CellPtr cell_;
  const Robot& robot_;
  Plant plant_;
  Log log_;
  std::vector<Simulated> arms_;
  std::optional<TimePoint> now_;
  Eigen::VectorXd position_;  // commanded, by row of the plant
  Eigen::VectorXd velocity_;
  std::vector<std::string> told_;  // pairs of bodies that have touched
};

}  // namespace armloom

#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/model/cell.h"
#include "server/physics/servo.h"

namespace armloom {

struct PlantOptions {
  std::optional<RobotId> robot;  // nullopt: all robots of the cell
  std::optional<Payload> payload;
  // If false, the servo compensates neither weight nor inertia of the payload.
  bool is_payload_known = false;
  // Share by which the servo overestimates all masses and inertias. Identified models of real
  // robots have such errors; without an error, tracking would be unrealistically good.
  double mass_error = 0.05;
};

// State at the end of a period. Vectors have one entry per joint of Plant::joints().
struct PlantState {
  Eigen::VectorXd position;  // rad or m; without sensor noise
  Eigen::VectorXd velocity;  // rad/s or m/s
  Eigen::VectorXd torque;    // N m or N, of the drives in the last internal step
  // Pairs of bodies that touched during the period and may not (mjcf.h).
  std::vector<BodyContact> contacts;
};

// A robot (or all robots of a cell) with masses, drives, brakes and contacts, simulated by MuJoCo.
// Deterministic: the same calls on the same machine give the same states, bit for bit. Confined to
// one thread at a time.
class Plant {
 public:
  // Largest internal time step.
  static constexpr Duration kStepMax = std::chrono::microseconds(500);

  // Starts at rest at cell->home() with drives on. Adds an assumption to `warnings` for each kind
  // of value that the URDF lacks. Returns the problems of make_mjcf() or MujocoModel::compile(), or
  // a problem "payload-too-heavy" if the drives cannot hold the payload at home.
  [[nodiscard]] static Result<Plant> create(CellPtr cell, const PlantOptions& options,
                                            Problems& warnings);

  // The joints of the simulated robots, in the order of the cell. Mimic joints have a drive of
  // their own, which follows the command of the joint that they mimic.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }

  // Places the robots at `position` (as joints()) at rest, and commands this position.
  void place(const Eigen::VectorXd& position);

  // Simulates one period, at whose end the drives should have reached `position` and `velocity`
  // (as joints()). The reference moves there smoothly from the previous command. A command that
  // jumps is followed as fast as the torque limits permit. Returns state(). Throws
  // std::invalid_argument if a size is wrong, a number is not finite, or the period is not
  // positive; std::runtime_error if the simulation diverges.
  const PlantState& step(Duration period, const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity);

  // Switches the drives of an arm and its gripper. Off: no torque, and holding brakes engage. A
  // brake acts as dry friction, with the effort limit of its joint, until the joint has been at
  // rest for kBrakeLocks. Then the brake locks the joint. Commands for these joints have no effect.
  // On: the drives hold the present position until the next command.
  void switch_drives(ArmId arm, bool on);
  static constexpr Duration kBrakeLocks = std::chrono::milliseconds(10);

  [[nodiscard]] const PlantState& state() const { return state_; }
  // Kinetic plus potential energy (J), up to a constant.
  [[nodiscard]] double energy_j() const;

 private:
  Plant(CellPtr cell, const PlantOptions& options, std::unique_ptr<MujocoModel> real,
        std::unique_ptr<MujocoModel> known);
  [[nodiscard]] std::optional<Problem> fault_of(const Payload& payload);
  void measure();
  void lock_brakes(Duration period);
  void throw_if_invalid(Duration period, const Eigen::VectorXd& position,
                        const Eigen::VectorXd& velocity) const;

  CellPtr cell_;
  std::vector<JointId> joints_;
  std::unique_ptr<MujocoModel> mujoco_;
  std::unique_ptr<MujocoModel> known_;  // what the servo knows
  std::unique_ptr<Servo> servo_;
  std::vector<Eigen::Index> row_of_driven_;  // in joints_
  std::vector<std::size_t> driven_of_row_;   // the link that the joint itself drives
  std::vector<bool> drive_on_;               // by row
  std::vector<Duration> at_rest_;            // by driven link, while its drive is off
  Eigen::VectorXd command_;                  // at the end of the last period, by row
  Eigen::VectorXd command_rate_;
  std::vector<Servo::Reference> references_;  // by driven link
  PlantState state_;
};

}  // namespace armloom

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/arm/arm_controller.h"
#include "core/arm/arm_fault.h"
#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

struct MadeController {
  std::unique_ptr<ArmController> controller;
  FaultTarget* faults = nullptr;  // part of the controller; null if it takes no faults
};

// Makes the controller of one arm. `q`: positions of the arm's joints and gripper joints at the
// start, for a simulation. `seed`: of its noise and faults. Problems: pointers lead into the cell
// file.
using MakeController = std::function<Result<MadeController>(const CellPtr& cell, ArmId arm,
                                                            Eigen::VectorXd q, std::uint64_t seed)>;
// By ControllerDescription::type.
using ControllerTypes = std::map<std::string, MakeController>;

// Returns simulations for all types of the cell file: "sim", and "remote" for runs without the real
// controllers.
[[nodiscard]] ControllerTypes simulated_controllers();

// Makes the controllers of all arms, by ArmId, with every arm at home. Problem: a type that is not
// in `types`.
[[nodiscard]] Result<std::vector<MadeController>> make_controllers(const CellPtr& cell,
                                                                   const ControllerTypes& types,
                                                                   std::uint64_t seed);

}  // namespace armloom

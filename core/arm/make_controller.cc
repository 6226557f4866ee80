#include "core/arm/make_controller.h"

#include <utility>
#include <vector>

#include "core/arm/faulty_link.h"
#include "core/arm/simulated_arm.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

std::string listed(const ControllerTypes& types) {
  std::string names;
  for (const auto& [name, make] : types) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

ControllerTypes simulated_controllers() {
  const auto make = [](const CellPtr& cell, ArmId arm, Eigen::VectorXd q,
                       std::uint64_t seed) -> Result<MadeController> {
    auto simulated = std::make_unique<SimulatedArm>(cell, arm, std::move(q), seed);
    auto faulty = std::make_unique<FaultyArm>(std::move(simulated), seed);
    auto made = std::make_unique<FaultyLink>(std::move(faulty), seed);
    FaultyLink* faults = made.get();
    return MadeController{std::move(made), faults};
  };
  return {{"sim", make}, {"remote", make}};
}

Result<std::vector<MadeController>> make_controllers(const CellPtr& cell,
                                                     const ControllerTypes& types,
                                                     std::uint64_t seed) {
  std::vector<MadeController> made;
  for (std::uint32_t a = 0; a < cell->arms.size(); ++a) {
    const Arm& arm = cell->arms[a];
    const std::string& type = cell->robots[arm.robot.index()].controller.type;
    const auto make = types.find(type);
    if (make == types.end()) {
      return failure(
          Problem{ProblemKind::invalid, "unknown-controller",
                  "/robots/" + std::to_string(arm.robot.index()) + "/controller/type",
                  "unknown controller type \"" + type + "\"; known here: " + listed(types), type});
    }
    auto controller =
        make->second(cell, ArmId{a}, joints_of(cell->home(), joints_and_gripper(arm)), seed + a);
    if (!controller) return failure(std::move(controller.error()));
    made.push_back(std::move(*controller));
  }
  return made;
}

}  // namespace armloom

// An executive for a cell: its policy, its scene, its arms.
#include <utility>

#include "core/arm/simulated_arm.h"
#include "core/collision/state/check_home.h"
#include "core/executive/executive_impl.h"

namespace armloom {
namespace {

Result<std::shared_ptr<const Policy>> policy_of(const Cell& cell, const ExecutiveOptions& options) {
  if (options.own_policy) return options.own_policy;
  auto named = make_policy(options.policy.empty() ? cell.scheduling.policy : options.policy, cell);
  if (named) return std::shared_ptr<const Policy>(std::move(*named));
  if (!options.policy.empty()) named.error().front().pointer = "--policy";
  return failure(std::move(named.error()));
}

// At home.
std::vector<std::unique_ptr<FaultyArm>> simulated_arms(const CellPtr& cell, std::uint64_t seed) {
  std::vector<std::unique_ptr<FaultyArm>> arms;
  const Configuration home = cell->home();
  for (std::size_t a = 0; a < cell->arms.size(); ++a) {
    const Arm& arm = cell->arms[a];
    std::vector<JointId> joints = arm.joints;
    joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
    Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
    for (std::size_t j = 0; j < joints.size(); ++j) {
      q[static_cast<Eigen::Index>(j)] = home[static_cast<Eigen::Index>(joints[j].index())];
    }
    arms.push_back(std::make_unique<FaultyArm>(std::make_unique<SimulatedArm>(
        cell, ArmId{static_cast<std::uint32_t>(a)}, std::move(q), seed + a)));
  }
  return arms;
}

}  // namespace

Result<std::unique_ptr<Executive>> Executive::create(CellPtr cell, ExecutiveOptions options,
                                                     JudgementService& judges, Observer& observer) {
  auto policy = policy_of(*cell, options);
  if (!policy) return failure(std::move(policy.error()));
  auto scene = PlanningScene::build(cell);
  if (!scene) return failure(std::move(scene.error()));
  if (auto problems = check_home(*scene); !problems.empty()) return failure(std::move(problems));

  for (std::size_t r = 0; r < cell->robots.size(); ++r) {
    const std::string& type = cell->robots[r].controller.type;
    if (type == "sim") continue;
    return failure(Problem{ProblemKind::invalid, "unknown-controller",
                           "/robots/" + std::to_string(r) + "/controller/type",
                           "unknown controller type \"" + type + "\"; known is sim", type});
  }

  Impl::Checked checked{cell, std::move(*scene), std::move(*policy),
                        simulated_arms(cell, options.seed)};
  return std::unique_ptr<Executive>(new Executive(
      std::make_unique<Impl>(std::move(checked), std::move(options), judges, observer)));
}

}  // namespace armloom

// An executive for a cell: its policy, its scene, its arms.
#include <utility>

#include "core/arm/make_controller.h"
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

}  // namespace

Result<std::unique_ptr<Executive>> Executive::create(CellPtr cell, ExecutiveOptions options,
                                                     JudgementService& judges, Observer& observer) {
  auto policy = policy_of(*cell, options);
  if (!policy) return failure(std::move(policy.error()));
  auto scene = PlanningScene::build(cell);
  if (!scene) return failure(std::move(scene.error()));
  if (auto problems = check_home(*scene); !problems.empty()) return failure(std::move(problems));

  auto arms = make_controllers(
      cell, options.controllers.empty() ? simulated_controllers() : options.controllers,
      options.seed);
  if (!arms) return failure(std::move(arms.error()));

  Impl::Checked checked{cell, std::move(*scene), std::move(*policy), std::move(*arms)};
  return std::unique_ptr<Executive>(new Executive(
      std::make_unique<Impl>(std::move(checked), std::move(options), judges, observer)));
}

}  // namespace armloom

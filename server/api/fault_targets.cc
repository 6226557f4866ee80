#include "server/api/fault_targets.h"

#include <algorithm>
#include <utility>

namespace armloom {

ControllerTypes FaultTargets::watched(ControllerTypes types) {
  for (auto& [type, make] : types) {
    make = [this, make](const CellPtr& cell, ArmId arm, Eigen::VectorXd q,
                        std::uint64_t seed) -> Result<MadeController> {
      auto made = make(cell, arm, std::move(q), seed);
      if (made && made->faults != nullptr) targets_.push_back({cell->arm(arm).name, made->faults});
      return made;
    };
  }
  return types;
}

FaultListing FaultTargets::list(TimePoint now) const {
  FaultListing listing{now, {}};
  for (const Target& target : targets_) {
    for (const auto& [id, fault] : target.faults->faults()) {
      if (fault.is_over(now)) continue;
      FaultView view{id, {target.arm, fault.kind, fault.from, std::nullopt, fault.value}};
      if (fault.until) {
        view.fault.lasting = *fault.until - fault.from;
        view.remaining = *fault.until - std::max(now, fault.from);
      }
      listing.faults.push_back(std::move(view));
    }
  }
  std::ranges::sort(listing.faults, {}, &FaultView::id);
  return listing;
}

}  // namespace armloom

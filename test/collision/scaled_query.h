#pragma once

#include <optional>
#include <vector>

#include "core/collision/state/clearance_query.h"
#include "core/model/cell.h"

namespace armloom::small {

// A ClearanceQuery with a chosen clearance per call; self and mount clearances scale with it.
struct ScaledQuery : ClearanceQuery {
  using ClearanceQuery::ClearanceQuery;

  std::vector<NearPair> near(const Configuration& q, double clearance_m,
                             const std::vector<bool>& of) {
    set_limits(PairLimits::scaled(scene().cell(), clearance_m));
    std::vector<NearPair> near;
    near_pairs(q, of, std::vector<bool>(of.size(), true), near);
    set_limits(PairLimits::of(scene().cell()));
    return near;
  }
  std::vector<NearPair> near(const Configuration& q, double clearance_m) {
    return near(q, clearance_m, std::vector<bool>(scene().cell().arms.size(), true));
  }
  std::optional<Proximity> first_closer_than(const Configuration& q, double clearance_m,
                                             const std::vector<bool>& arms) {
    const auto found = near(q, clearance_m, arms);
    return found.empty() ? std::nullopt : std::optional(describe(found.front()));
  }
  std::vector<Proximity> all_closer_than(const Configuration& q, double clearance_m) {
    set_limits(PairLimits::scaled(scene().cell(), clearance_m));
    auto found = closest_too_close(q);
    set_limits(PairLimits::of(scene().cell()));
    return found;
  }
};

}  // namespace armloom::small

#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"

namespace armloom {

// Two arms, or an arm and the scene, that will come too close unless an arm stops now.
struct StopConflict {
  ArmId a;
  std::optional<ArmId> b = {};  // nullopt: the scene, or an arm that a stop does not affect
  // Stopping this arm alone resolves the conflict. If neither suffices, both must stop.
  bool a_suffices = true;
  bool b_suffices = true;

  [[nodiscard]] bool is_resolved_by(bool a_stops, bool b_stops) const {
    if (!b) return a_stops;
    return (a_stops && a_suffices) || (b_stops && b_suffices) || (a_stops && b_stops);
  }
};

// Returns the smallest set of arms, ascending, whose stop resolves all conflicts. Of several sets,
// the one whose first differing arm has the smaller id. Exact for groups of up to kExactArms arms
// that are connected by conflicts. In a larger group, the arm with the most unresolved conflicts is
// stopped until none is left; this may stop more arms than needed. Pure.
inline constexpr std::size_t kExactArms = 12;
[[nodiscard]] std::vector<ArmId> smallest_stop_set(const std::vector<StopConflict>& conflicts);

}  // namespace armloom

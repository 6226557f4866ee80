#include "core/collision/parting.h"

#include <algorithm>

namespace armloom {

PairSet held_to_less(PairSet pairs, const std::vector<CoordinationDiagram::Close>& close,
                     double share) {
  const auto lower = [&](auto& entries, std::vector<NarrowPair>& narrow) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const auto found =
          std::ranges::find(close, narrow[i].pair, &CoordinationDiagram::Close::pair);
      if (found == close.end()) continue;
      narrow[i].limit_m = std::max(share * found->distance_m, 1e-9);
      entries[i].limit_up = round_up(narrow[i].limit_m);
    }
  };
  lower(pairs.pairs, pairs.narrow);
  lower(pairs.boxes, pairs.narrow_boxes);
  return pairs;
}

}  // namespace armloom

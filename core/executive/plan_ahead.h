#pragma once

#include <optional>
#include <vector>

#include "core/coordination/diagram.h"

namespace armloom {

// Returns the first contact of two motions if both go on from their progress at the same speed (45
// degrees in their diagram) and the one that ends first rests at its goal: the first cell in
// conflict or, if there is none, the first undecided cell. (Each conflict has a seam of undecided
// cells, which is not reported before it.) A corner that is only touched is not entered. nullopt if
// all cells are free. Preconditions: 0 <= at <= end for each.
struct DiagramContact {
  DiagramCell::State state;
  Duration after;       // from now
  Duration at_a, at_b;  // trajectory times then
};
[[nodiscard]] std::optional<DiagramContact> first_met(const std::vector<DiagramCell>& cells,
                                                      Duration at_a, Duration at_b, Duration end_a,
                                                      Duration end_b);

}  // namespace armloom

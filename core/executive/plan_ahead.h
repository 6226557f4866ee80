#pragma once

#include <optional>
#include <vector>

#include "core/coordination/diagram.h"

namespace armloom {

// Returns the first contact of two motions if both go on from their progress (`at_a`, `at_b`) at
// their planned speed, and the motion that ends first rests at its goal. In their diagram this is a
// line at 45 degrees, then along an edge. The contact is the first cell in conflict on this line;
// if there is none, the first undecided cell. (Undecided cells lie around each conflict, so they
// are reported only if there is no conflict.) A cell that is touched only at a corner is not
// entered. nullopt if all cells on the line are free. Preconditions: 0 <= at <= end for each.
struct DiagramContact {
  DiagramCell::State state;
  Duration after;       // from now
  Duration at_a, at_b;  // trajectory times then
};
[[nodiscard]] std::optional<DiagramContact> first_met(const std::vector<DiagramCell>& cells,
                                                      Duration at_a, Duration at_b, Duration end_a,
                                                      Duration end_b);

}  // namespace armloom

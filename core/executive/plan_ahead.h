#pragma once

#include <optional>
#include <vector>

#include "core/coordination/diagram.h"

namespace armloom {

// What two motions meet if both go on from where they are, second by second (45 degrees in their
// diagram), and whoever ends first rests at its goal (along the border): the first cell in
// conflict, or, where there is none, the first that is undecided. Around each conflict lies a seam
// of undecided cells, which says nothing more. A corner that is only touched is not entered.
// Nothing: the way leads through free cells only. Preconditions: 0 <= at <= end of each.
struct DiagramContact {
  DiagramCell::State state;
  Duration after;       // from now
  Duration at_a, at_b;  // trajectory times then
};
[[nodiscard]] std::optional<DiagramContact> first_met(const std::vector<DiagramCell>& cells,
                                                      Duration at_a, Duration at_b, Duration end_a,
                                                      Duration end_b);

}  // namespace armloom

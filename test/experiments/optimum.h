#pragma once

#include <string>
#include <vector>

#include "test/experiments/joined_diagram.h"

namespace armloom::experiments {

// The shortest time in which two arms can come to the ends of all their motions, in their order, if
// both may pause anywhere at no cost and know everything beforehand: the shortest monotone way
// through the coordination diagram of all of one's motions against all of the other's
// (O'Donnell and Lozano-Perez 1989). In it no state is closer than the cell's clearance_m; that an
// arm may be off its path, brakes before a pause, and needs a moment between two motions is left
// out. For more than two arms the largest over all pairs: a bound only, for the third has to find
// its way, too.
//
// On the squares of JoinedDiagram. least_s: those are closed that are in conflict all over; no way
// is shorter than that. most_s: those are open that are free all over; there is such a way. The
// true optimum lies between.
struct Optimum {
  double least_s = 0.0;
  double most_s = 0.0;
  std::vector<std::string> arms;  // the pair that needs most
};
// `work`: of each arm in its order, every motion beginning where the one before ends. Precondition
// (throws std::invalid_argument): durations are multiples of
// JoinedDiagram::kSquare. Throws std::runtime_error when
// there is no way, or the scene cannot be built.
[[nodiscard]] Optimum optimum(const CellPtr& cell, const std::vector<Work>& work);

}  // namespace armloom::experiments

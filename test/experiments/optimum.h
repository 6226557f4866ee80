#pragma once

#include <string>
#include <vector>

#include "test/experiments/joined_diagram.h"

namespace armloom::experiments {

// The shortest time in which two arms can finish their motions, in order, if they may pause
// anywhere at no cost and know everything beforehand: the shortest monotone path through the
// coordination diagram of all motions (O'Donnell and Lozano-Perez 1989), with the cell's
// clearance_m. Ignores tracking errors, braking, and gaps between motions. For more than two arms,
// the largest over all pairs, a bound only.
// On the squares of JoinedDiagram: for least_s only squares in conflict all over are closed, for
// most_s only squares free all over are open. The true optimum lies between.
struct Optimum {
  double least_s = 0.0;
  double most_s = 0.0;
  std::vector<std::string> arms;  // the pair with the longest time
};
// `work`: each arm's motions in order, end to end. Throws std::invalid_argument if a duration is
// not a multiple of JoinedDiagram::kSquare, std::runtime_error if there is no path or the scene
// cannot be built.
[[nodiscard]] Optimum optimum(const CellPtr& cell, const std::vector<Work>& work);

}  // namespace armloom::experiments

#pragma once

#include <string>
#include <vector>

#include "test/experiments/joined_diagram.h"

namespace armloom::experiments {

// The shortest time in which two arms can finish their motions in order, if they know everything in
// advance and may pause anywhere at no cost. It is the shortest monotone path through the
// coordination diagram of all motions (O'Donnell and Lozano-Perez 1989), with the cell's
// clearance_m. Tracking errors, braking and gaps between motions are ignored. For more than two
// arms it is only a lower bound: the largest time of any pair.
//
// The diagram consists of squares (JoinedDiagram). For least_s only squares that are in conflict
// all over are closed; for most_s only squares that are free all over are open. The true optimum
// lies between these two times.
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

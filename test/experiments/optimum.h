#pragma once

#include <string>
#include <vector>

#include "test/experiments/joined_diagram.h"

namespace armloom::experiments {

// The shortest time in which two arms can finish all their motions, in order, if both can pause
// anywhere at no cost and know everything beforehand. This is the shortest monotone path through
// the coordination diagram of all motions of one arm against all of the other (O'Donnell and
// Lozano-Perez 1989). No state on the path is closer than the cell's clearance_m. Tracking errors,
// braking before a pause, and the gap between two motions are ignored. For more than two arms: the
// largest over all pairs, which is only a bound, because the third arm must find its path too.
//
// Computed on the squares of JoinedDiagram. least_s: only squares that are in conflict all over are
// closed; no path is shorter. most_s: only squares that are free all over are open; such a path
// exists. The true optimum lies between.
struct Optimum {
  double least_s = 0.0;
  double most_s = 0.0;
  std::vector<std::string> arms;  // the pair with the longest time
};
// `work`: the motions of each arm in order, each starting at the end of the previous one. Throws
// std::invalid_argument if a duration is not a multiple of JoinedDiagram::kSquare, and
// std::runtime_error if there is no path or the scene cannot be built.
[[nodiscard]] Optimum optimum(const CellPtr& cell, const std::vector<Work>& work);

}  // namespace armloom::experiments

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom::experiments {

// A lower bound for every order and pace: the larger of
// - own: the busiest arm's own work, the sum of its jobs' durations;
// - excluding: work that excludes each other. If every moment of a set of arm A's jobs conflicts
//   with every moment of a set of B's (closer than the cell's clearance), they take the sum of
//   their times.
// The largest pair of sets is a maximum biclique of the conflict graph: by Koenig's theorem, the
// vertices of its bipartite complement minus a maximum matching (Hopcroft and Karp). More than two
// arms: the largest over all pairs, or over sets of all arms in which all moments of different arms
// conflict, found greedily (may be too small).
struct LowerBound {
  double own_s = 0.0;
  double excluding_s = 0.0;
  std::string busiest;                 // arm
  std::vector<std::string> excluding;  // arms
  [[nodiscard]] double bound_s() const { return own_s > excluding_s ? own_s : excluding_s; }
};

// One motion of one arm, which must be clear with all other arms at home.
struct Work {
  ArmId arm;
  TrajectoryPtr motion;
  TimePoint from{};  // not known before this time; ignored for the lower bound
};
// Moments are samples every `step`. The result is rounded down: only the time between neighboring
// chosen moments counts, without the last partial step.
[[nodiscard]] LowerBound lower_bound(const CellPtr& cell, const std::vector<Work>& work,
                                     Duration step);

// ---- The graph alone ----

// True if moment a of A conflicts with moment b of B: [a * columns + b].
struct ConflictTable {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<char> conflict;
};
struct ChosenMoments {
  std::vector<char> rows;
  std::vector<char> columns;
};
// Returns the largest sets of rows and columns in which every pair conflicts.
[[nodiscard]] ChosenMoments largest_exclusion(const ConflictTable& table);

// Returns moments of more than two arms that exclude each other, chosen greedily: no two of them
// are compatible. `free[i * n + j]`: i and j are compatible.
[[nodiscard]] std::vector<char> exclusion_of_all(const std::vector<char>& free, std::size_t n);

// Counts the steps between neighboring samples of one motion that are both chosen. `motion[i]` is
// the motion of sample i; samples of one motion are consecutive.
[[nodiscard]] std::size_t steps_chosen(const std::vector<char>& chosen,
                                       const std::vector<std::size_t>& motion);

}  // namespace armloom::experiments

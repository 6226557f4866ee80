#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom::experiments {

// What no order of the jobs and no pace can beat: the larger of
//  own:       the busiest arm's own work, the sum of its jobs' durations;
//  excluding: the work that excludes each other. If every moment of a set of moments of arm A's
//             jobs is in conflict with every moment of a set of B's (the arms would be closer than
//             the cell's clearance), no two of them can be at once: together they take their sum.
// The largest such pair of sets is a maximum biclique of the conflict graph by number of vertices:
// the maximum independent set of its bipartite complement, by Koenig's theorem all vertices less a
// maximum matching (Hopcroft and Karp). For more than two arms the largest over all pairs of arms,
// or over sets of all arms in which every two moments of different arms conflict, found greedily
// (which can only be too small).
struct LowerBound {
  double own_s = 0.0;
  double excluding_s = 0.0;
  std::string busiest;                 // arm
  std::vector<std::string> excluding;  // arms
  [[nodiscard]] double bound_s() const { return own_s > excluding_s ? own_s : excluding_s; }
};

// One motion of one arm; every one must be clear with all other arms at home (the states that are
// looked at hold two arms under way and the others at home).
struct Work {
  ArmId arm;
  TrajectoryPtr motion;
  TimePoint from{};  // it is not known before; of no account for the lower bound
};
// Moments are samples every `step`. Rounded down: a chosen sample counts only together with its
// chosen neighbour, for the time between them; what lies after the last whole step counts nothing.
[[nodiscard]] LowerBound lower_bound(const CellPtr& cell, const std::vector<Work>& work,
                                     Duration step);

// ---- The graph by itself ----

// Which moment of A is in conflict with which of B: [a * columns + b].
struct ConflictTable {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<char> conflict;
};
struct ChosenMoments {
  std::vector<char> rows;
  std::vector<char> columns;
};
// The largest sets of rows and columns, by their common number, in which every pair conflicts.
[[nodiscard]] ChosenMoments largest_exclusion(const ConflictTable& table);

// The largest exclusion among more than two kinds, greedily: `free[i * n + j]` says that i and j
// may be at once. Always: no two of those chosen may.
[[nodiscard]] std::vector<char> exclusion_of_all(const std::vector<char>& free, std::size_t n);

// Chosen samples as time: the steps between samples of one motion that are both chosen. `motion[i]`
// is the motion of sample i; samples of one motion follow each other.
[[nodiscard]] std::size_t steps_chosen(const std::vector<char>& chosen,
                                       const std::vector<std::size_t>& motion);

}  // namespace armloom::experiments

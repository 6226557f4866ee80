#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"

namespace armloom::experiments {

// A lower bound for every order of the jobs and every pace: the larger of
// - own: the busiest arm's own work, the sum of its jobs' durations;
// - excluding: the work that excludes each other. If every moment of a set of moments of arm A's
//   jobs conflicts with every moment of a set of B's (the arms would be closer than the cell's
//   clearance), no two of them can coincide. Together they take the sum of their times.
// The largest such pair of sets is a maximum biclique of the conflict graph by number of vertices.
// That is the maximum independent set of its bipartite complement: by Koenig's theorem, all
// vertices minus a maximum matching (Hopcroft and Karp). For more than two arms, the bound is the
// largest over all pairs of arms. It may also be the largest over sets of all arms in which every
// two moments of different arms conflict. These sets are found greedily, which can only make the
// bound too small.
struct LowerBound {
  double own_s = 0.0;
  double excluding_s = 0.0;
  std::string busiest;                 // arm
  std::vector<std::string> excluding;  // arms
  [[nodiscard]] double bound_s() const { return own_s > excluding_s ? own_s : excluding_s; }
};

// One motion of one arm. Every motion must be clear with all other arms at home, because the
// checked states have two arms under way and the other arms at home.
struct Work {
  ArmId arm;
  TrajectoryPtr motion;
  TimePoint from{};  // not known before this time; ignored for the lower bound
};
// Moments are samples every `step`. Rounded down: a chosen sample counts only with its chosen
// neighbor, for the time between them. Time after the last whole step is ignored.
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
// Returns the largest sets of rows and columns, by their total number, in which every pair
// conflicts.
[[nodiscard]] ChosenMoments largest_exclusion(const ConflictTable& table);

// Returns a large exclusion among more than two arms, found greedily. `free[i * n + j]` is true if
// i and j are compatible. No two of the returned moments are compatible.
[[nodiscard]] std::vector<char> exclusion_of_all(const std::vector<char>& free, std::size_t n);

// Returns chosen samples as time: the number of steps between neighboring samples of one motion
// that are both chosen. `motion[i]` is the motion of sample i; samples of one motion must be
// consecutive.
[[nodiscard]] std::size_t steps_chosen(const std::vector<char>& chosen,
                                       const std::vector<std::size_t>& motion);

}  // namespace armloom::experiments

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/collision/diagram/cell_tree.h"
#include "core/collision/diagram/passing_edges.h"
#include "core/collision/diagram/progress_band.h"
#include "core/collision/diagram/tube_pair.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// The progress of two motions of different arms determines if they collide (O'Donnell and
// Lozano-Perez 1989). Cells over (trajectory time of A, trajectory time of B) are certified
// free, in conflict, or not known yet. They are refined only where a question needs it, and kept,
// so that repeating a question costs next to nothing. For one arm against static bodies, or against
// itself, the second axis has no length.
//
// A cell is free if every pair of bodies keeps its limit in all its states: the distance at its
// middle, less the motion of both bodies within the cell (MotionTube), is at least the limit.
// Capsules are tried first, then the exact distance, last the motion of the bodies towards each
// other only (body_sweep.h).
//
// Not thread-safe; diagrams of one thread may share tubes.
class CoordinationDiagram {
 public:
  explicit CoordinationDiagram(TubePair pair);
  [[nodiscard]] TubePair& pair() { return pair_; }
  // Without its tubes.
  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(tree_.size()) * sizeof(Node) +
           found_.size() * sizeof(NarrowWitness);
  }

  struct Witness {
    PairId pair;
    double distance_m;  // exact if below the limit, else a lower bound
    Duration time_a;    // trajectory times
    Duration time_b;
    double at_s;  // from the start of the question's band until it first contains this state
  };
  struct Answer {
    bool free = false;
    bool exhausted = false;  // the budget ended before the question was decided
    // If proven, the first conflict in time, to within kFirst_s; else the first cell that could not
    // be decided. nullopt if free.
    std::optional<Witness> conflict;
    bool proven = false;
    std::uint64_t evaluations = 0;  // cells and states
  };
  // Evaluates at most `budget` cells and states. The refine functions stop within a batch of eight
  // after `budget`; they return the number of evaluated cells (at least `budget` if interrupted).
  [[nodiscard]] Answer ask(const ProgressBand& band, std::uint64_t budget);

  // Refines what remains of both motions until each cell is free, in conflict, or no wider than
  // `resolution`.
  std::uint64_t refine(Duration now_a, Duration now_b, Duration resolution, std::uint64_t budget);

  // Refines the border of the free part of what remains of both motions: cells that touch a free
  // cell, or an edge where a motion is now. They become no wider than `fine`, or `coarse` if their
  // middle is in conflict, and as `passing` requires where motions pass a region. Cells behind the
  // border are not evaluated: no motion gets there.
  struct Resolution {
    Duration coarse;
    Duration fine;
    PassingResolution passing;
  };
  //
  // Long motions begin with wider cells, so that the budget goes where motions are close. A full
  // diagram (kFull) is not refined further; it starts again when less than half of its area
  // remains.
  std::uint64_t refine_outline(Duration now_a, Duration now_b, const Resolution& resolution,
                               std::uint64_t budget);

  // Returns the leaves of what remains that are not known to be free, in a fixed order.
  struct Blocked {
    ProgressBox box;
    std::optional<Witness> found;  // at the middle; at_s is not set
    bool proven = false;           // closer than its limit
  };
  [[nodiscard]] std::vector<Blocked> blocked(Duration now_a, Duration now_b) const;

  // Close passes leave cells that are neither free nor in conflict. Halves such cells with the
  // middle in one of `areas`, until each is free or no wider than `finest`. Stops at a proven
  // conflict, because it is no close pass.
  std::uint64_t refine_close_passes(const std::vector<ProgressBox>& areas, Duration finest,
                                    std::uint64_t budget);

  using CellState = CellTree::CellState;
  struct CellView {
    ProgressBox box;
    CellState state;
  };
  // Returns the leaves, in a fixed order. Unknown leaves were never needed.
  [[nodiscard]] std::vector<CellView> cells() const;

  // Largest share of the budget for the first cells.
  inline static constexpr double kFirstShare = 0.125;
  inline static constexpr int kFull = 1'000'000;

  inline static constexpr double kFirst_s = 0.01;

 private:
  using Node = CellTree::Node;
  struct NarrowWitness {  // at the middle of a cell
    PairId pair;
    int narrow;
    bool box;
    double distance_m;
  };
  struct Open {  // a cell that a question needs
    int cell;
    TimeRange times;
  };
  struct Search;

  // Questions (coordination_diagram.cc).
  [[nodiscard]] Witness witness_at(const Node& cell, PairId pair, double distance_m) const;
  [[nodiscard]] std::optional<TimeRange> meets(const ProgressBand& band, const Node& cell) const;
  void collect(int cell, Search& search);
  [[nodiscard]] const NarrowWitness* proven(const Node& cell) const;
  void consider_conflict(const Open& open, Search& search);
  [[nodiscard]] std::optional<Witness> on_the_line(const Open& open, const ProgressBand& band);

  // Refinement (diagram_refinement.cc).
  template <class Expand, class Follow>
  std::uint64_t refine_from(std::vector<int> leaves, std::uint64_t budget, const Expand& expand,
                            const Follow& follow);
  std::uint64_t refine_passing_edges(Duration now_a, Duration now_b,
                                     const PassingResolution& resolution, std::uint64_t budget);
  [[nodiscard]] double area_s2(Duration now_a, Duration now_b) const;
  [[nodiscard]] Duration first_width(Duration now_a, Duration now_b, std::uint64_t budget) const;
  void begin_anew_if_passed(Duration now_a, Duration now_b);
  void split_passing_edge(const CoarseLeaf& leaf, std::vector<int>& unknown);
  [[nodiscard]] bool is_open(const Node& cell, Duration now_a, Duration now_b) const;
  [[nodiscard]] OpenLeaf open_leaf(int cell) const;
  [[nodiscard]] bool is_outlined(Duration now_a, Duration now_b,
                                 const Resolution& resolution) const;

  // A batch of cells (diagram_cells.cc).
  void evaluate(std::span<const int> cells);
  void decide(int cell, std::vector<TubePair::Undecided>& undecided);
  [[nodiscard]] TubePair::Nodes nodes_of(const Node& cell) const;
  void note(Node& cell, const NarrowWitness& found);
  void choose_split(Node& cell, const TubePair::Undecided& worst);
  [[nodiscard]] bool clears(Node& cell, TubePair::Undecided& undecided);

  TubePair pair_;
  CellTree tree_;  // axes: times of the tubes; the second may have no length
  std::vector<NarrowWitness> found_;
  struct Outlined {
    Duration now_a, now_b;
    Resolution resolution;
  };
  std::optional<Outlined> outlined_;  // last completed refine_outline()
  double begun_with_s2_ = 0.0;        // area at the first refine_outline()
};

}  // namespace armloom
